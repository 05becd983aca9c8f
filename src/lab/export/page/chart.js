// The chart under the pitch: a lane for each robot, and on it either its messages or its states, over some seconds around now.

const NAMES = 66, AXIS = 18;

class Chart {
  constructor(canvas, match) {
    this.canvas = canvas;
    this.match = match;
    this.hits = [];
    this.recolour();
  }

  recolour() {
    this.colours = {};
    for (const name of ["sunken", "text", "quiet", "line", "home-text", "away-text", "lost", "penalty", "lock", "ball", "swap", "raised", "accent"]) {
      this.colours[name] = css(name);
    }
  }

  draw(now, view) {
    const { context: pen, width, height } = fitted(this.canvas);
    this.pen = pen;
    const c = this.colours;
    const ticks = view.span / this.match.dt;
    this.from = now - ticks / 2;
    this.scale = (width - NAMES) / ticks;
    const lanes = this.match.robots.length;
    this.lane = (height - AXIS) / lanes;
    this.hits = [];
    pen.fillStyle = c.sunken;
    pen.fillRect(0, 0, width, height);
    pen.font = FONT;
    pen.textBaseline = "middle";
    this.drawAxis(width, height, view.span);
    pen.save();
    pen.beginPath(); pen.rect(NAMES, 0, width - NAMES, height - AXIS); pen.clip();
    if (view.chart === "messages") this.drawMessages(width, view); else this.drawStates(width);
    const x = this.x(now);
    pen.strokeStyle = c.text; pen.lineWidth = 1;
    pen.beginPath(); pen.moveTo(x, 0); pen.lineTo(x, height - AXIS); pen.stroke();
    pen.restore();
    this.match.robots.forEach((robot, i) => {
      pen.fillStyle = c[`${TEAMS[robot.team]}-text`];
      pen.textAlign = "left";
      pen.fillText((view.selected === i ? "▸ " : "") + robot.name, 6, this.y(i));
    });
  }

  x(tick) { return NAMES + (tick - this.from) * this.scale; }
  y(lane) { return this.lane * (lane + 0.5); }
  tickAt(x) { return this.from + (x - NAMES) / this.scale; }

  drawAxis(width, height, span) {
    const { pen, colours: c } = this;
    const step = [0.2, 0.5, 1, 2, 5, 10].find((step) => span / step <= 12);
    const start = Math.ceil(Math.max(0, this.match.seconds(this.from)) / step) * step;
    pen.textAlign = "center";
    for (let second = start; second <= this.match.seconds(this.from) + span; second += step) {
      const x = this.x(second / this.match.dt);
      pen.strokeStyle = c.line; pen.lineWidth = 1;
      pen.beginPath(); pen.moveTo(x, 0); pen.lineTo(x, height - AXIS); pen.stroke();
      pen.fillStyle = c.quiet;
      pen.fillText(`${second.toFixed(step < 1 ? 1 : 0)} s`, x, height - AXIS / 2);
    }
  }

  bars(spans, lane, draw, tell) {
    const [first, last] = [this.from, this.tickAt(this.canvas.getBoundingClientRect().width)];
    for (const span of spans) {
      if (span[1] < first || span[0] > last) continue;
      const [left, right] = [this.x(span[0]), Math.max(this.x(span[1]), this.x(span[0]) + 2)];
      draw(left, right - left, this.y(lane), span);
      this.hits.push({ left, right, top: this.y(lane) - this.lane / 2, bottom: this.y(lane) + this.lane / 2, text: tell(span) });
    }
  }

  drawMessages(width, view) {
    const { pen, match, colours: c } = this;
    const lasts = (span) => `from ${seconds(match, span[0])}, for ${((span[1] - span[0]) * match.dt).toFixed(2)} s`;
    match.robots.forEach((robot, lane) => {
      const y = this.y(lane);
      pen.strokeStyle = c.line; pen.lineWidth = 1;
      pen.beginPath(); pen.moveTo(NAMES, y); pen.lineTo(width, y); pen.stroke();
      const mate = (number) => `${TEAMS[robot.team]} ${number}`;
      const bar = (colour, half) => (left, wide, at) => { pen.fillStyle = c[colour]; pen.fillRect(left, at - half, wide, 2 * half); };
      this.bars(robot.claims, lane, bar("ball", 1.5), (span) => `${robot.name} claims the ball\n${lasts(span)}`);
      this.bars(robot.bookings, lane,
        (left, wide, at, span) => { if (span[3]) bar("ball", 3)(left, wide, at); },
        (span) => `${robot.name} ${span[3] ? "has booked the ball and goes to it" : `believes that ${mate(span[2])} has booked the ball`}\n${lasts(span)}`);
      this.bars(robot.locks, lane, bar("lock", 3.5), (span) => `${robot.name} is locked by ${mate(span[2])}, attempt ${span[3]}\n${lasts(span)}`);
      this.bars(robot.attempts, lane,
        (left, wide, at) => { pen.strokeStyle = c.lock; pen.lineWidth = 1.5; pen.strokeRect(left, at - 3.5, wide, 7); },
        (span) => `${robot.name} tries to swap roles, attempt ${span[2]}\n${lasts(span)}`);
    });
    const sent = match.messagesSent(this.from - LONGEST_WAY / match.dt, this.tickAt(width));
    const shown = sent.filter((message) => view.kinds.has(message.kind));
    this.taken = [];
    let labelled = "";
    for (const message of shown) {
      this.drawArrow(message);
      const what = [message.kind, message.attempt, message.from, message.sent].join();
      if (shown.length < 150 && what !== labelled) this.drawLabel(message);
      labelled = what;
    }
  }

  arrow(message) {
    const from = { x: this.x(message.sent), y: this.y(message.from) };
    const way = message.lost ? 4 : message.arrives - message.sent;
    const to = { x: this.x(message.sent + way), y: this.y(message.to) };
    return message.lost ? { from, to: { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 } } : { from, to };
  }

  colour(message) {
    if (message.lost) return this.colours.lost;
    return message.attempt ? this.colours.swap : this.colours[`${TEAMS[this.match.robots[message.from].team]}-text`];
  }

  drawArrow(message) {
    const { pen, colours: c } = this;
    const { from, to } = this.arrow(message);
    pen.strokeStyle = pen.fillStyle = this.colour(message);
    pen.lineWidth = message.attempt ? 1.6 : 1;
    pen.setLineDash(message.late ? [5, 3.5] : []);
    pen.beginPath(); pen.moveTo(from.x, from.y); pen.lineTo(to.x, to.y); pen.stroke();
    pen.setLineDash([]);
    if (message.lost) {
      pen.strokeStyle = c.penalty; pen.lineWidth = 1.8;
      for (const side of [1, -1]) { pen.beginPath(); pen.moveTo(to.x - 3.5, to.y - 3.5 * side); pen.lineTo(to.x + 3.5, to.y + 3.5 * side); pen.stroke(); }
    } else {
      const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
      const [ux, uy] = [(to.x - from.x) / length, (to.y - from.y) / length];
      pen.beginPath(); pen.moveTo(to.x, to.y);
      pen.lineTo(to.x - 6 * ux + 3 * uy, to.y - 6 * uy - 3 * ux);
      pen.lineTo(to.x - 6 * ux - 3 * uy, to.y - 6 * uy + 3 * ux);
      pen.fill();
    }
    this.hits.push({ line: [from, to], text: story(this.match, message) });
  }

  drawLabel(message) {
    const { pen } = this;
    const { from, to } = this.arrow(message);
    const text = label(message);
    const wide = pen.measureText(text).width + 6;
    const at = { x: (from.x + to.x) / 2 + wide / 2 + 3, y: (from.y + to.y) / 2 };
    const box = [at.x - wide / 2, at.y - 7, at.x + wide / 2, at.y + 7];
    if (this.taken.some((other) => box[0] < other[2] && box[2] > other[0] && box[1] < other[3] && box[3] > other[1])) return;
    this.taken.push(box);
    pen.fillStyle = this.colours.sunken;
    pen.globalAlpha = 0.75; pen.fillRect(box[0], box[1], wide, 14); pen.globalAlpha = 1;
    pen.fillStyle = this.colour(message);
    pen.textAlign = "center";
    pen.fillText(text, at.x, at.y);
  }

  drawStates(width) {
    const { pen, match, colours: c } = this;
    const last = this.tickAt(width);
    match.robots.forEach((robot, lane) => {
      const top = this.y(lane) - 0.42 * this.lane, high = 0.84 * this.lane;
      robot.states.forEach(([since, role, acting, state, because], i) => {
        const until = i + 1 < robot.states.length ? robot.states[i + 1][0] : match.ticks;
        if (until < this.from || since > last) return;
        const [left, right] = [this.x(since), this.x(until)];
        pen.fillStyle = stateColour(state);
        pen.fillRect(left, top, Math.max(right - left - 1, 1), high);
        const words = state.split("/").pop().replaceAll("_", " ");
        const visible = Math.min(right, width) - Math.max(left, NAMES);
        if (pen.measureText(words).width + 8 < visible) {
          pen.fillStyle = "#101210"; pen.textAlign = "left";
          pen.fillText(words, Math.max(left, NAMES) + 4, this.y(lane));
        }
        const as = acting === role ? role : `${role} as ${acting}`;
        const why = because ? `\nbecause ${because}` : "";
        const text = `${robot.name}, ${as}: ${state}\nfrom ${seconds(match, since)}, for ${((until - since) * match.dt).toFixed(2)} s${why}`;
        this.hits.push({ left, right, top, bottom: top + high, text });
      });
    });
    pen.fillStyle = c.text;
  }

  // What there is to tell of what is under a point.
  tell(x, y) {
    const near = this.hits.filter((hit) => hit.line && distance({ x, y }, ...hit.line) < 5);
    near.sort((a, b) => distance({ x, y }, ...a.line) - distance({ x, y }, ...b.line));
    if (near.length) return near[0].text;
    const inside = this.hits.filter((hit) => !hit.line && x >= hit.left && x <= hit.right && y >= hit.top && y <= hit.bottom);
    return inside.length ? inside[inside.length - 1].text : null;
  }
}

function distance(point, from, to) {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const share = Math.min(1, Math.max(0, ((point.x - from.x) * dx + (point.y - from.y) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(point.x - from.x - share * dx, point.y - from.y - share * dy);
}

const seconds = (match, tick) => `${match.seconds(tick).toFixed(2)} s`;
const label = (message) => (message.attempt ? `${message.kind} ${message.attempt}` : message.kind);

function story(match, message) {
  const [from, to] = [match.robots[message.from], match.robots[message.to]];
  const took = Math.round(1000 * match.seconds(message.arrives - message.sent));
  const fate = message.lost ? `lost: ${message.lost}` : `arrived after ${took} ms${message.late ? ", late" : ""}`;
  return `${label(message)} from ${from.name} to ${to.name}\nsent at ${seconds(match, message.sent)}\n${fate}`;
}

// A state of one name has one colour, pale enough for dark words.
const STATE_COLOURS = ["#8eb8e5", "#e6e08a", "#9ccf8e", "#c9a27e", "#b7a3e0", "#7fc9c0", "#d7d7d2", "#c98fb4", "#f0b27a", "#aab7c4"];
const stateNames = [];
function stateColour(state) {
  const name = state.split("/").pop();
  if (!stateNames.includes(name)) stateNames.push(name);
  return STATE_COLOURS[stateNames.indexOf(name) % STATE_COLOURS.length];
}
