// The controls of the page: time, keys, what is shown.

const $ = (id) => document.getElementById(id);
const SPEEDS = [0.125, 0.25, 0.5, 1, 2, 4, 8, 16];
// How long a call of the referee is shown, s.
const CALLED = 3;

class Page {
  constructor(match) {
    this.match = match;
    this.now = 0;
    this.playing = false;
    this.speed = SPEEDS.indexOf(1);
    this.view = {
      beliefs: false, labels: true, teamwork: true, selected: null, chart: "messages", span: 12,
      kinds: new Set(match.messages.map((message) => message.kind)), forks: new Set(),
    };
    for (const robot of match.robots) for (const row of robot.states) stateColour(row[3]);
    this.pitch = new PitchPicture($("pitch"), match);
    this.chart = new Chart($("chart"), match);
    this.line = new TimeLine($("line"), match);
    this.writeNames();
    this.writeRobots();
    this.writeKinds();
    this.writeEvents();
    this.writeForks();
    this.listen();
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.dark.addEventListener("change", () => this.setTheme(null));
    this.setTheme(null);
    this.showChart("messages");
    requestAnimationFrame((time) => this.frame(time));
  }

  frame(time) {
    const passed = Math.min((time - (this.before ?? time)) / 1000, 0.25);
    this.before = time;
    if (this.playing) {
      this.now = Math.min(this.now + (passed * SPEEDS[this.speed]) / this.match.dt, this.match.ticks);
      if (this.now === this.match.ticks) this.setPlaying(false);
      this.stale = true;
    }
    if (this.stale) this.draw();
    requestAnimationFrame((next) => this.frame(next));
  }

  draw() {
    this.stale = false;
    this.pitch.draw(this.now, this.view);
    this.chart.draw(this.now, this.view);
    this.line.draw(this.now, this.view);
    this.tellState();
    this.tellRobots();
  }

  tellState() {
    const { phase, half, left, score } = this.match.phase(this.now);
    const whole = Math.max(0, Math.ceil(left));
    const clock = `${String(Math.floor(whole / 60)).padStart(2, "0")}:${String(whole % 60).padStart(2, "0")}`;
    write($("score"), score.join(" : "));
    write($("clock"), phase === "finished" ? "full time" : `${clock} left, ${half === 1 ? "first" : "second"} half`);
    write($("phase"), phase);
    const called = this.match.events.filter((event) => event.tick <= this.now && this.match.seconds(this.now - event.tick) < CALLED);
    write($("call"), called.length ? (called.find((event) => event.kind === "goal") || called[called.length - 1]).text : "");
    write($("time"), `${this.match.seconds(this.now).toFixed(2)} s · tick ${Math.floor(this.now)}`);
    $("line").setAttribute("aria-valuenow", Math.floor(this.now));
  }

  tellRobots() {
    this.match.robots.forEach((robot, i) => {
      const { since, role, acting, state, because } = robot.state(this.now);
      const [, what, lasts] = this.rows[i].cells;
      write(what.querySelector(".role"), acting === role ? role : `${role} as ${acting}`);
      write(what.querySelector(".doing"), ` ${state.replaceAll("_", " ")}`);
      write(what.querySelector(".sign"), [signText(robot, this.now), spanAt(robot.locks, this.now) ? "locked for a role swap" : ""].filter(Boolean).join(", "));
      write(what.querySelector("small"), because ? `because ${because}` : "");
      write(lasts, `${this.match.seconds(this.now - since).toFixed(1)} s`);
      this.rows[i].setAttribute("aria-selected", this.view.selected === i);
    });
  }

  ticksOf(seconds) { return Math.round(seconds / this.match.dt); }

  goTo(tick) {
    this.now = Math.min(Math.max(tick, 0), this.match.ticks);
    this.stale = true;
  }

  step(ticks) {
    this.setPlaying(false);
    this.goTo(Math.floor(this.now + 1e-6) + ticks);
  }

  // The next event or the one before, as many of them as matter to a spectator.
  goToEvent(direction) {
    const ticks = this.match.events.filter((event) => event.kind !== "role").map((event) => event.tick);
    const later = direction > 0 ? ticks.find((tick) => tick > this.now) : ticks.reverse().find((tick) => tick < Math.floor(this.now));
    if (later !== undefined) this.goTo(later);
  }

  setPlaying(playing) {
    if (playing && this.now >= this.match.ticks) this.goTo(0);
    this.playing = playing;
    write($("play"), playing ? "❚❚ Pause" : "▶ Play");
    this.stale = true;
  }

  setSpeed(speed) {
    this.speed = Math.min(Math.max(speed, 0), SPEEDS.length - 1);
    const factor = SPEEDS[this.speed];
    write($("speed"), factor < 1 ? `1/${1 / factor}×` : `${factor}×`);
  }

  toggle(what) {
    this.view[what] = !this.view[what];
    $(`show-${what}`).setAttribute("aria-pressed", this.view[what]);
    this.stale = true;
  }

  toggleFork(i) {
    if (i >= this.match.forks.length) return;
    const { forks } = this.view;
    if (!forks.delete(i)) forks.add(i);
    const button = $("forks").children[i].querySelector("button");
    button.setAttribute("aria-pressed", forks.has(i));
    write(button, forks.has(i) ? `${i + 1} on` : `${i + 1} off`);
    this.stale = true;
  }

  select(robot) {
    this.view.selected = this.view.selected === robot ? null : robot;
    this.stale = true;
  }

  selectNext(step) {
    const count = this.match.robots.length;
    this.view.selected = ((this.view.selected ?? (step > 0 ? -1 : 0)) + step + count) % count;
    this.stale = true;
  }

  showChart(chart) {
    this.view.chart = chart;
    for (const name of ["messages", "states"]) $(`tab-${name}`).setAttribute("aria-selected", chart === name);
    $("kinds").hidden = chart !== "messages";
    this.stale = true;
  }

  // Light, dark, or as the system has it.
  setTheme(theme) {
    const wanted = theme || (this.dark.matches ? "dark" : "light");
    document.documentElement.dataset.theme = wanted;
    write($("theme"), wanted === "dark" ? "Light" : "Dark");
    for (const part of [this.pitch, this.chart, this.line]) part.recolour();
    this.stale = true;
  }

  writeNames() {
    const { match } = this;
    document.title = `${match.teams.join(" – ")}, ${match.phase(match.ticks).score.join(":")}`;
    write($("home"), match.teams[0]);
    write($("away"), match.teams[1]);
    const { place, heading } = match.exact;
    write($("source"), `${match.program}, ${match.name}, seed ${match.seed}, digest ${match.digest}. Places are exact to ${1000 * place[1]} mm, ` +
      `headings to ${Math.round((180 / Math.PI) * heading[1])}°. Position messages and ball reports are left out.`);
    $("line").setAttribute("aria-valuemin", 0);
    $("line").setAttribute("aria-valuemax", match.ticks);
  }

  writeRobots() {
    const body = $("robots").tBodies[0];
    this.rows = this.match.robots.map((robot, i) => {
      const row = body.insertRow();
      const shirt = element("span", "shirt", robot.number);
      shirt.style.background = `var(--${TEAMS[robot.team]})`;
      row.insertCell().append(shirt);
      const what = row.insertCell();
      what.append(element("span", "role"), element("span", "doing"), " ", element("span", "sign"), element("small"));
      row.insertCell().className = "since";
      row.title = `${robot.name}: click to see its beliefs alone`;
      row.addEventListener("click", () => this.select(i));
      return row;
    });
  }

  writeKinds() {
    const kinds = [...this.view.kinds].sort();
    for (const kind of kinds) {
      const button = element("button", "", kind);
      button.title = `Whether ${kind} messages are shown`;
      button.setAttribute("aria-pressed", true);
      button.addEventListener("click", () => {
        if (!this.view.kinds.delete(kind)) this.view.kinds.add(kind);
        button.setAttribute("aria-pressed", this.view.kinds.has(kind));
        this.stale = true;
      });
      $("kinds").append(button);
    }
    if (!kinds.length) $("kinds").append(element("span", "quiet", "no messages but routine news"));
  }

  writeEvents() {
    for (const event of this.match.events) {
      const item = element("li");
      const dot = element("span", "dot");
      dot.style.background = eventColour(event);
      const jump = element("button", "", event.text);
      jump.addEventListener("click", () => { this.setPlaying(false); this.goTo(event.tick); });
      item.append(element("time", "", minutes(this.match.seconds(event.tick))), dot, jump);
      $("events").append(item);
    }
  }

  writeForks() {
    $("fork-part").hidden = this.match.forks.length === 0;
    this.match.forks.forEach((fork, i) => {
      const item = element("li");
      const button = element("button", "", `${i + 1} off`);
      button.setAttribute("aria-pressed", false);
      button.title = i < 9 ? `Switch it on or off (${i + 1})` : "Switch it on or off";
      button.addEventListener("click", () => this.toggleFork(i));
      const jump = element("button", "jump", fork.title);
      jump.title = "Go to where it leaves the match";
      jump.addEventListener("click", () => {
        if (!this.view.forks.has(i)) this.toggleFork(i);
        this.goTo(fork.from);
      });
      const words = element("div");
      words.append(jump, element("small", "", `${minutes(this.match.seconds(fork.from))}: ${fork.detail}`));
      item.append(button, words);
      $("forks").append(item);
    });
  }

  listen() {
    const click = (id, act) => $(id).addEventListener("click", act);
    click("play", () => this.setPlaying(!this.playing));
    click("back", () => this.step(-1));
    click("ahead", () => this.step(1));
    click("slower", () => this.setSpeed(this.speed - 1));
    click("faster", () => this.setSpeed(this.speed + 1));
    click("help", () => this.showKeys());
    click("theme", () => this.toggleTheme());
    for (const what of ["beliefs", "labels", "teamwork"]) click(`show-${what}`, () => this.toggle(what));
    for (const chart of ["messages", "states"]) click(`tab-${chart}`, () => this.showChart(chart));
    $("span").addEventListener("change", (event) => { this.view.span = Number(event.target.value); this.stale = true; });
    window.addEventListener("resize", () => { this.stale = true; });
    new ResizeObserver(() => { this.stale = true; }).observe($("pitch"));
    document.addEventListener("keydown", (event) => this.press(event));
    this.listenToPointers();
  }

  listenToPointers() {
    const line = $("line");
    line.addEventListener("pointerdown", (event) => {
      line.setPointerCapture(event.pointerId);
      this.goTo(this.line.meant(event.offsetX));
    });
    line.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) this.goTo(this.line.tickAt(event.offsetX));
      tip(this.line.tell(event.offsetX), event);
    });
    const chart = $("chart");
    chart.addEventListener("pointerdown", (event) => { this.dragged = event.offsetX; chart.setPointerCapture(event.pointerId); });
    chart.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) {
        this.setPlaying(false);
        this.goTo(this.now - (event.offsetX - this.dragged) / this.chart.scale);
        this.dragged = event.offsetX;
      }
      tip(this.chart.tell(event.offsetX, event.offsetY), event);
    });
    for (const canvas of [line, chart]) canvas.addEventListener("pointerleave", () => tip(null));
    $("pitch").addEventListener("click", (event) => {
      this.view.selected = this.pitch.robotAt(event.offsetX, event.offsetY, this.now);
      this.stale = true;
    });
  }

  toggleTheme() { this.setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"); }

  showKeys() {
    const list = $("keys").querySelector("dl");
    if (!list.children.length) {
      for (const [keys, , what] of KEYS) if (what) list.append(element("dt", "", keys.map((key) => KEY_NAMES[key] || key).join(" ")), element("dd", "", what));
    }
    $("keys").showModal();
  }

  press(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || $("keys").open || event.target.tagName === "SELECT") return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const known = KEYS.find(([keys]) => keys.includes(key));
    if (!known) return;
    event.preventDefault();
    known[1](this, event);
  }
}

const KEY_NAMES = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓" };
// Keys, what they do, and how the help says it.
const KEYS = [
  [[" "], (page) => page.setPlaying(!page.playing), "play or pause"],
  [[","], (page) => page.step(-1), "one tick back"],
  [["."], (page) => page.step(1), "one tick ahead"],
  [["ArrowLeft"], (page, event) => page.goTo(page.now - page.ticksOf(event.shiftKey ? 10 : 1)), "a second back, ten with Shift"],
  [["ArrowRight"], (page, event) => page.goTo(page.now + page.ticksOf(event.shiftKey ? 10 : 1)), "a second ahead, ten with Shift"],
  [["ArrowUp"], (page) => page.goToEvent(-1), "the event before"],
  [["ArrowDown"], (page) => page.goToEvent(1), "the next event"],
  [["Home"], (page) => page.goTo(0), "the beginning"],
  [["End"], (page) => page.goTo(page.match.ticks), "the end"],
  [["+", "="], (page) => page.setSpeed(page.speed + 1), "faster"],
  [["-"], (page) => page.setSpeed(page.speed - 1), "slower"],
  [["b"], (page) => page.toggle("beliefs"), "what robots believe"],
  [["l"], (page) => page.toggle("labels"), "labels"],
  [["t"], (page) => page.toggle("teamwork"), "claims, locks, bookings and messages on the pitch"],
  [["m"], (page) => page.showChart("messages"), "who said what to whom"],
  [["s"], (page) => page.showChart("states"), "what each robot did, and why"],
  [["]"], (page) => page.selectNext(1), "the next robot"],
  [["["], (page) => page.selectNext(-1), "the robot before"],
  [["Escape"], (page) => { page.view.selected = null; page.stale = true; }, "no robot"],
  [["d"], (page) => page.toggleTheme(), "light or dark"],
  [["1", "2", "3", "4", "5", "6", "7", "8", "9"], (page, event) => page.toggleFork(Number(event.key) - 1), "another future on or off"],
  [["?", "F1"], (page) => page.showKeys(), "these keys"],
];

const minutes = (seconds) => `${String(Math.floor(seconds / 60)).padStart(2, "0")}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;

function write(node, text) { if (node.textContent !== text) node.textContent = text; }

function element(tag, name = "", text = "") {
  const node = document.createElement(tag);
  if (name) node.className = name;
  node.textContent = text;
  return node;
}

function tip(text, event) {
  const node = $("tip");
  node.hidden = !text;
  if (!text) return;
  write(node, text);
  const box = node.getBoundingClientRect();
  node.style.left = `${Math.min(event.clientX + 14, innerWidth - box.width - 8)}px`;
  node.style.top = `${event.clientY + 18 + box.height > innerHeight ? event.clientY - box.height - 12 : event.clientY + 18}px`;
}

readMatch($("match").textContent).then(
  (match) => { window.touchline = new Page(match); },
  (error) => { $("trouble").hidden = false; write($("trouble"), `This match cannot be shown: ${error.message}. A browser of 2023 or newer is needed.`); },
);
