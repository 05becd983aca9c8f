// Draws the pitch and what is on it at a moment.

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const TEAMS = ["home", "away"];
// Width of the lines of a pitch with walls and of one whose lines are painted, of walls and of mowing stripes, m.
const LINE = 0.04, PAINTED = 0.025, WALL = 0.12, STRIPE = 0.75;
// Width of the line around a part of a robot, m.
const EDGE = 0.012;
// The trail of the ball: how many places, and how many ticks lie between two.
const TRAIL = 14, TRAIL_TICKS = 3;
// The longest way of a message that is looked for, s.
const LONGEST_WAY = 4;
const FONT = '12px system-ui, Ubuntu, "DejaVu Sans", sans-serif';

// Fits a canvas to its place on the page, in device pixels, and returns its context in units of the page.
function fitted(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const { width, height } = canvas.getBoundingClientRect();
  const [wide, high] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
  if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height, ratio };
}

class PitchPicture {
  constructor(canvas, match) {
    this.canvas = canvas;
    this.match = match;
    this.ground = document.createElement("canvas");
    this.colours = {};
    this.recolour();
  }

  recolour() {
    const names = ["floor", "carpet", "stripe", "fence", "chalk", "blue-goal", "yellow-goal", "robot", "head", "robot-edge",
      "ball", "ball-edge", "lock", "home", "away", "lost", "penalty", "label", "label-text"];
    for (const name of names) this.colours[name] = css(name);
    this.groundKey = "";
  }

  // The scale and the middle that show the whole pitch.
  frame(width, height) {
    const { length, width: across, goal, margin } = this.match.pitch;
    const half = { x: length / 2 + Math.max(goal[1] + WALL, margin) + 0.12, y: across / 2 + Math.max(WALL, margin) + 0.12 };
    return { scale: Math.min(width / (2 * half.x), height / (2 * half.y)), x: width / 2, y: height / 2 };
  }

  draw(now, view) {
    const { context, width, height, ratio } = fitted(this.canvas);
    this.frameNow = this.frame(width, height);
    const { scale, x, y } = this.frameNow;
    this.drawGround(width, height, ratio);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.ground, 0, 0);
    context.restore();
    context.save();
    context.translate(x, y);
    context.scale(scale, -scale);
    this.pen = context;
    this.pixel = 1 / scale;
    const poses = this.match.robots.map((robot) => robot.pose(now));
    this.drawTrail(now);
    if (view.teamwork) this.drawRings(now, poses);
    if (view.selected !== null) this.ring(poses[view.selected], 1.36 * this.match.robots[view.selected].kind.reach, TEAMS[this.match.robots[view.selected].team], 2);
    this.match.forks.forEach((fork, i) => { if (view.forks.has(i)) this.drawFork(fork, now); });
    this.match.robots.forEach((robot, i) => this.drawRobot(robot, poses[i], robot.has(SIGNS.off, now) ? 0.45 : 1));
    const [bx, by] = this.match.ballTrack.at(now);
    this.drawBall(bx, by, 1);
    if (view.beliefs) this.drawBeliefs(now, poses, view.selected);
    if (view.teamwork) this.drawMessages(now, poses, view.kinds);
    context.restore();
    if (view.labels) this.drawLabels(context, now, poses);
  }

  drawGround(width, height, ratio) {
    const key = [this.canvas.width, this.canvas.height].join();
    if (key === this.groundKey) return;
    this.groundKey = key;
    [this.ground.width, this.ground.height] = [this.canvas.width, this.canvas.height];
    const pen = this.ground.getContext("2d");
    const c = this.colours;
    const { scale, x, y } = this.frame(width, height);
    pen.fillStyle = c.floor;
    pen.fillRect(0, 0, this.ground.width, this.ground.height);
    pen.setTransform(ratio * scale, 0, 0, -ratio * scale, ratio * x, ratio * y);
    const { length, width: across, goal, area, circle, spots, margin, wall } = this.match.pitch;
    const [hx, hy, post, deep] = [length / 2, across / 2, goal[0] / 2, goal[1]];
    const box = (cx, cy, rx, ry, colour) => { pen.fillStyle = colour; pen.fillRect(cx - rx, cy - ry, 2 * rx, 2 * ry); };
    const open = margin > 0;
    if (open) {
      box(0, 0, hx + margin + wall, hy + margin + wall, c.fence);
    } else {
      box(0, 0, hx + WALL, hy + WALL, c.chalk);
      for (const side of [1, -1]) box(side * (hx + (deep + WALL) / 2), 0, (deep + WALL) / 2, post + WALL, c.chalk);
    }
    const line = open ? PAINTED : LINE;
    // No carpet shows between a wall and its line.
    const [cx, cy] = open ? [hx + margin, hy + margin] : [hx - line / 2, hy - line / 2];
    const stripes = 2 * Math.max(1, Math.round(cx / STRIPE));
    for (let i = 0; i < stripes; i++) {
      pen.fillStyle = i % 2 ? c.stripe : c.carpet;
      pen.fillRect(-cx + (2 * cx * i) / stripes, -cy, (2 * cx) / stripes, 2 * cy);
    }
    for (const [side, colour] of [[-1, c["yellow-goal"]], [1, c["blue-goal"]]]) {
      if (open) box(side * (hx + deep / 2 + wall / 2), 0, deep / 2 + wall / 2, post + wall, c.chalk);
      box(side * (hx + deep / 2), 0, deep / 2, post, colour);
    }
    pen.strokeStyle = pen.fillStyle = c.chalk;
    pen.lineWidth = line;
    const frame = (ax, ay, bx, by) => pen.strokeRect(ax + line / 2, ay + line / 2, bx - ax - line, by - ay - line);
    frame(-hx, -hy, hx, hy);
    frame(-hx, -area[1] / 2, -hx + area[0], area[1] / 2);
    frame(hx - area[0], -area[1] / 2, hx, area[1] / 2);
    pen.fillRect(-line / 2, -hy, line, 2 * hy);
    pen.beginPath(); pen.arc(0, 0, circle, 0, 2 * Math.PI); pen.stroke();
    pen.beginPath(); pen.arc(0, 0, line, 0, 2 * Math.PI); pen.fill();
    for (const [sx, sy] of spots.filter(([sx, sy]) => Math.hypot(sx, sy) > line)) {
      pen.fillRect(sx - 1.6 * line, sy - line / 4, 3.2 * line, line / 2);
      pen.fillRect(sx - line / 4, sy - 1.6 * line, line / 2, 3.2 * line);
    }
  }

  drawRobot(robot, pose, opacity) {
    this.pen.save();
    this.pen.globalAlpha = opacity;
    this.drawParts(robot, pose);
    this.pen.restore();
  }

  // Goes into the frame of a part of a robot.
  enter(kind, pose, part) {
    this.pen.save();
    this.pen.translate(pose.x, pose.y);
    this.pen.rotate(part === "trailer" && pose.trailer !== null ? pose.trailer : pose.heading);
    if (part === "head") { this.pen.translate(...kind.neck); this.pen.rotate(pose.head); }
  }

  drawParts(robot, pose) {
    const { pen, colours: c } = this;
    const ink = { body: c.robot, dark: c.robot, edge: c["robot-edge"], head: c.head, team: c[TEAMS[robot.team]] };
    for (const part of robot.kind.parts) {
      this.enter(robot.kind, pose, part.of);
      this.path(part.points);
      pen.fillStyle = ink[part.ink];
      pen.fill();
      if (part.ink === "body") { pen.strokeStyle = ink.edge; pen.lineWidth = EDGE; pen.stroke(); }
      pen.restore();
    }
    const { plate, plate_on, plate_half } = robot.kind;
    const size = 1.5 * plate_half / this.pixel;
    if (size < 7) return;
    this.enter(robot.kind, pose, plate_on);
    pen.translate(...plate);
    // Numbers stand upright, whichever way the robot looks.
    pen.rotate(-(plate_on === "trailer" && pose.trailer !== null ? pose.trailer : pose.heading));
    pen.scale(this.pixel, -this.pixel);
    pen.fillStyle = "#101210";
    pen.font = `${size}px system-ui, Ubuntu, "DejaVu Sans", sans-serif`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillText(robot.number, 0, 0.05 * size);
    pen.restore();
  }

  path(points) {
    this.pen.beginPath();
    points.forEach(([x, y], i) => (i ? this.pen.lineTo(x, y) : this.pen.moveTo(x, y)));
    this.pen.closePath();
  }

  drawBall(x, y, opacity) {
    const { pen, colours: c } = this;
    const { radius } = this.match.ball;
    pen.save();
    pen.globalAlpha = opacity;
    pen.fillStyle = c["ball-edge"];
    pen.beginPath(); pen.arc(x, y, 1.14 * radius, 0, 2 * Math.PI); pen.fill();
    pen.fillStyle = c.ball;
    pen.beginPath(); pen.arc(x, y, 0.96 * radius, 0, 2 * Math.PI); pen.fill();
    pen.restore();
  }

  drawTrail(now) {
    const { pen, match } = this;
    let newer = null;
    for (let i = 1; i <= TRAIL; i++) {
      const place = now - i * TRAIL_TICKS >= 0 ? match.ballTrack.at(now - i * TRAIL_TICKS) : null;
      if (!place || (newer && Math.hypot(place[0] - newer[0], place[1] - newer[1]) > CARRIED)) return;
      newer = place;
      const left = 1 - i / TRAIL;
      pen.globalAlpha = 0.3 * left;
      pen.fillStyle = this.colours.ball;
      pen.beginPath(); pen.arc(place[0], place[1], match.ball.radius * (0.35 + 0.5 * left), 0, 2 * Math.PI); pen.fill();
      pen.globalAlpha = 1;
    }
  }

  ring(at, radius, colour, pixels, dashed = false) {
    const { pen } = this;
    pen.strokeStyle = this.colours[colour];
    pen.lineWidth = pixels * this.pixel;
    pen.setLineDash(dashed ? [5 * this.pixel, 4 * this.pixel] : []);
    pen.beginPath(); pen.arc(at.x, at.y, radius, 0, 2 * Math.PI); pen.stroke();
    pen.setLineDash([]);
  }

  segment(from, to, colour, pixels) {
    const { pen } = this;
    pen.strokeStyle = this.colours[colour];
    pen.lineWidth = pixels * this.pixel;
    pen.beginPath(); pen.moveTo(from.x, from.y); pen.lineTo(to.x, to.y); pen.stroke();
  }

  // An orange ring for a claim, an amber one for a lock, an orange line to the ball for a booking.
  drawRings(now, poses) {
    const [x, y] = this.match.ballTrack.at(now);
    this.match.robots.forEach((robot, i) => {
      const reach = robot.kind.reach;
      if (spanAt(robot.claims, now)) this.ring(poses[i], 1.14 * reach, "ball", 2.5);
      if (spanAt(robot.locks, now)) this.ring(poses[i], 1.28 * reach, "lock", 2.5);
      if (spanAt(robot.attempts, now)) this.ring(poses[i], 1.28 * reach, "lock", 1.5, true);
      const booking = spanAt(robot.bookings, now);
      if (booking && booking[3]) this.segment(poses[i], { x, y }, "ball", 2);
    });
  }

  // Dashed in the team's colour, with a thin line to what is true.
  drawBeliefs(now, poses, selected) {
    const { match } = this;
    const [x, y] = match.ballTrack.at(now);
    match.robots.forEach((robot, i) => {
      const believed = robot.believed.at(now);
      if (!believed || (selected !== null && selected !== i)) return;
      const own = TEAMS[robot.team];
      const itself = { x: believed[0], y: believed[1] };
      this.ring(itself, robot.kind.reach, own, 2, true);
      const reach = 1.3 * robot.kind.reach;
      this.segment(itself, { x: itself.x + reach * Math.cos(believed[2]), y: itself.y + reach * Math.sin(believed[2]) }, own, 2);
      this.segment(itself, poses[i], own, 1);
      const ball = robot.believedBall.at(now);
      if (ball) {
        this.ring({ x: ball[0], y: ball[1] }, match.ball.radius, own, 2, true);
        this.segment({ x: ball[0], y: ball[1] }, { x, y }, own, 1);
      }
      if (selected === i) {
        for (const other of robot.othersBelieved(now)) this.ring(other, robot.kind.reach, TEAMS[other.team], 2, true);
      }
    });
  }

  // A small dot travels from the sender to the receiver; a lost one stops half-way, turns grey and falls.
  drawMessages(now, poses, kinds) {
    const { pen, match } = this;
    for (const message of match.messagesSent(now - LONGEST_WAY / match.dt, now)) {
      if (!kinds.has(message.kind)) continue;
      const [from, to] = [poses[message.from], poses[message.to]];
      const since = now - message.sent;
      const swap = message.attempt > 0;
      let share, fade = 1, fall = 0, colour = TEAMS[match.robots[message.from].team];
      if (message.lost) {
        share = Math.min(0.5, since / 6);
        if (since > 3) { fall = (since - 3) * match.dt / 0.7; fade = 1 - fall; colour = "lost"; }
      } else {
        share = Math.min(1, since / Math.max(1, message.arrives - message.sent));
        if (now > message.arrives) fade = 1 - (now - message.arrives) * match.dt / 0.35;
      }
      if (fade <= 0) continue;
      pen.globalAlpha = fade;
      const at = { x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y) };
      this.segment(from, at, colour, swap ? 1.4 : 0.7);
      pen.fillStyle = this.colours[colour];
      pen.beginPath(); pen.arc(at.x, at.y - 0.35 * fall * fall, (swap ? 5 : 3.5) * this.pixel, 0, 2 * Math.PI); pen.fill();
      pen.globalAlpha = 1;
    }
  }

  drawFork(fork, now) {
    if (now < fork.from || now > fork.until) return;
    fork.bodies.forEach((body, i) => {
      const [x, y, heading] = body.track.at(now);
      const trailer = body.trailer && body.trailer.at(now);
      this.drawRobot(this.match.robots[i], { x, y, heading, trailer: trailer ? trailer[0] : null, head: 0 }, 0.42);
    });
    const [x, y] = fork.ballTrack.at(now);
    this.drawBall(x, y, 0.5);
    this.ring({ x, y }, 1.5 * this.match.ball.radius, "chalk", 1.5, true);
  }

  toPage(point) {
    const { scale, x, y } = this.frameNow;
    return { x: x + scale * point.x, y: y - scale * point.y };
  }

  // The role by its tag, and the activity where there is room; beside the robot, where no other label and no robot is.
  drawLabels(context, now, poses) {
    const close = this.frameNow.scale > 55;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.font = FONT;
    const middles = poses.map((pose) => this.toPage(pose));
    const taken = [];
    this.match.robots.forEach((robot, i) => {
      const { role, acting, state } = robot.state(now);
      const tags = this.match.tags[robot.team];
      const trouble = signText(robot, now);
      const lines = [acting === role ? tags[role] || role : `${tags[role] || role} as ${tags[acting] || acting}`];
      if (close) lines.push(trouble || state.split("/").pop().replaceAll("_", " "));
      const size = [Math.max(...lines.map((line) => context.measureText(line).width)) + 8, 14 * lines.length + 3];
      const box = this.labelPlace(middles[i], size, robot.kind.reach, middles, taken);
      taken.push(box);
      context.fillStyle = this.colours.label;
      context.beginPath(); context.roundRect(...box, 4); context.fill();
      lines.forEach((line, row) => {
        context.fillStyle = row && trouble ? this.colours.penalty : this.colours["label-text"];
        context.fillText(line, box[0] + size[0] / 2, box[1] + 9 + 14 * row);
      });
    });
  }

  // Left, top, width and height of the best of some places: below, above, to the right and to the left, near and farther off.
  labelPlace(middle, [wide, high], reach, middles, taken) {
    const { scale } = this.frameNow;
    const places = [1.25, 2.1].flatMap((far) => {
      const away = far * reach * scale;
      return [[0, away + high / 2], [0, -away - high / 2], [away + wide / 2, 0], [-away - wide / 2, 0]];
    });
    const boxes = places.map(([x, y]) => [middle.x + x - wide / 2, middle.y + y - high / 2, wide, high]);
    const covered = (box) => {
      const labels = taken.filter((other) => overlap(box, other) > 0).length;
      const robots = middles.map((at) => overlap(box, [at.x - 0.2 * scale, at.y - 0.2 * scale, 0.4 * scale, 0.4 * scale]));
      return 10 * labels + robots.reduce((sum, area) => sum + area / (wide * high), 0);
    };
    return boxes.map((box, i) => [covered(box) + 0.01 * i, box]).sort((a, b) => a[0] - b[0])[0][1];
  }

  // The robot under a point of the page.
  robotAt(x, y, now) {
    const poses = this.match.robots.map((robot) => this.toPage(robot.pose(now)));
    const near = poses.map((at, i) => [Math.hypot(at.x - x, at.y - y), i]).sort((a, b) => a[0] - b[0])[0];
    return near && near[0] < 0.4 * this.frameNow.scale ? near[1] : null;
  }
}

// The area that two boxes share.
function overlap([ax, ay, aw, ah], [bx, by, bw, bh]) {
  return Math.max(0, Math.min(ax + aw, bx + bw) - Math.max(ax, bx)) * Math.max(0, Math.min(ay + ah, by + bh) - Math.max(ay, by));
}

// What is wrong or special with a robot, in words.
function signText(robot, now) {
  const words = [["off", "off the pitch"], ["crashed", "crashed"], ["frozen", "frozen"], ["deaf", "deaf"], ["mute", "mute"], ["piloted", "driven by a person"]];
  return words.filter(([sign]) => robot.has(SIGNS[sign], now)).map(([, text]) => text).join(", ");
}
