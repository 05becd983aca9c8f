// The match on a line: how far it has come, its goals and calls where they fell, and other futures above it.
class TimeLine {
  constructor(canvas, match) {
    this.canvas = canvas;
    this.match = match;
    this.recolour();
  }

  recolour() {
    this.colours = {};
    for (const name of ["raised", "accent", "quiet", "text", "home", "away", "lock", "penalty", "line", "chalk"]) this.colours[name] = css(name);
  }

  x(tick) { return 46 + (this.width - 92) * (tick / Math.max(1, this.match.ticks)); }
  tickAt(x) { return Math.min(Math.max(((x - 46) / (this.width - 92)) * this.match.ticks, 0), this.match.ticks); }
  near(x) { return this.match.events.filter((event) => Math.abs(this.x(event.tick) - x) < 6); }
  // The event that a click means, or the place itself.
  meant(x) {
    const near = this.near(x).sort((a, b) => Math.abs(this.x(a.tick) - x) - Math.abs(this.x(b.tick) - x));
    return near.length ? near[0].tick : Math.round(this.tickAt(x));
  }
  tell(x) {
    const near = this.near(x);
    if (near.length) return near.map((event) => `${minutes(this.match.seconds(event.tick))}  ${event.text}`).join("\n");
    return `${this.match.seconds(this.tickAt(x)).toFixed(1)} s`;
  }

  draw(now, view) {
    const { context: pen, width, height } = fitted(this.canvas);
    this.width = width;
    const c = this.colours, y = height - 14;
    pen.clearRect(0, 0, width, height);
    const stroke = (from, to, at, colour, wide) => { pen.fillStyle = colour; pen.fillRect(from, at - wide / 2, to - from, wide); };
    stroke(this.x(0), this.x(this.match.ticks), y, c.raised, 4);
    stroke(this.x(0), this.x(now), y, c.accent, 4);
    pen.font = FONT;
    pen.textBaseline = "middle";
    pen.fillStyle = c.quiet;
    pen.textAlign = "left"; pen.fillText(minutes(this.match.seconds(now)), 0, y);
    pen.textAlign = "right"; pen.fillText(minutes(this.match.seconds(this.match.ticks)), width, y);
    this.match.forks.forEach((fork, i) => {
      const [from, to] = [this.x(fork.from), Math.max(this.x(fork.until), this.x(fork.from) + 3)];
      stroke(from, to, 5 + 4 * (i % 3), view.forks.has(i) ? c.text : c.quiet, view.forks.has(i) ? 3 : 1.5);
    });
    for (const event of this.match.events) {
      const x = this.x(event.tick);
      pen.fillStyle = eventColour(event);
      if (event.kind === "goal") {
        pen.beginPath(); pen.arc(x, y, 6, 0, 2 * Math.PI); pen.fill();
        pen.strokeStyle = c.text; pen.lineWidth = 1.5; pen.stroke();
      } else if (event.kind === "role") {
        pen.beginPath(); pen.moveTo(x, y - 10); pen.lineTo(x + 3.5, y - 6.5); pen.lineTo(x, y - 3); pen.lineTo(x - 3.5, y - 6.5); pen.fill();
      } else {
        const reach = event.kind === "half" ? 9 : 6;
        pen.fillRect(x - 0.75, y - reach, 1.5, 2 * reach);
      }
    }
    pen.fillStyle = c.text;
    pen.beginPath(); pen.arc(this.x(now), y, 4.5, 0, 2 * Math.PI); pen.fill();
  }
}

function eventColour({ kind, team }) {
  if (kind === "goal") return css(TEAMS[team]);
  return css({ removal: "penalty", crash: "penalty", role: "lock", half: "quiet" }[kind] || "text");
}
