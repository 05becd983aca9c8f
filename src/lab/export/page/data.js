// Reads the match that is written into the page, and tells what holds at a tick.

const FORMAT = 1;

async function readMatch(text) {
  const packed = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const match = JSON.parse(await new Response(stream).text());
  if (match.format !== FORMAT) throw new Error(`this page reads format ${FORMAT}, not ${match.format}`);
  return new MatchReader(match);
}

// The sums of a column of differences.
function summed(differences, unit = 1) {
  const values = new Float64Array(differences.length);
  let sum = 0;
  for (let i = 0; i < values.length; i++) values[i] = (sum += differences[i]) * unit;
  return values;
}

// The place of the last number that is not greater; -1 if there is none.
function lastUpTo(sorted, value) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= value) low = middle + 1; else high = middle;
  }
  return low - 1;
}

// A body that moves farther than this in one tick was carried, m: it does not glide.
const CARRIED = 0.5;

// A way over time: straight lines between knots. There is nothing between two runs of knots.
class Track {
  constructor(table, units) {
    this.times = summed(table.t);
    this.values = table.v.map((column, i) => summed(column, units[i]));
    this.begins = new Set(table.runs || []);
  }

  at(tick) {
    const knot = lastUpTo(this.times, tick);
    if (knot < 0) return null;
    const here = this.values.map((column) => column[knot]);
    if (this.times[knot] === tick) return here;
    const next = knot + 1;
    if (next === this.times.length || this.begins.has(next)) return null;
    const ticks = this.times[next] - this.times[knot];
    const there = this.values.map((column) => column[next]);
    if (ticks === 1 && there.length > 1 && Math.hypot(there[0] - here[0], there[1] - here[1]) > CARRIED) return here;
    const share = (tick - this.times[knot]) / ticks;
    return here.map((value, i) => value + share * (there[i] - value));
  }
}

// The last row that begins up to a tick; rows begin with their ticks.
function rowAt(rows, tick) {
  let low = 0, high = rows.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rows[middle][0] <= tick) low = middle + 1; else high = middle;
  }
  return low ? rows[low - 1] : null;
}

// The span from its first tick until before its second that holds at a tick.
function spanAt(spans, tick) {
  const row = rowAt(spans, tick);
  return row && tick < row[1] ? row : null;
}

class Robot {
  constructor(data, match) {
    const { place, heading, believed_place, believed_heading } = match.exact;
    const pose = [place[0], place[0], heading[0]];
    Object.assign(this, data);
    this.kind = match.kinds[data.kind];
    this.track = new Track(data.track, pose);
    this.trailer = data.trailer && new Track(data.trailer, [heading[0]]);
    this.head = data.head && new Track(data.head, [believed_heading[0]]);
    this.believed = new Track(data.believed, [believed_place[0], believed_place[0], believed_heading[0]]);
    this.believedBall = new Track(data.believed_ball, [believed_place[0], believed_place[0]]);
    this.othersAt = summed(data.others.t);
    this.othersFrom = [0];
    for (const count of data.others.n) this.othersFrom.push(this.othersFrom[this.othersFrom.length - 1] + 2 * count);
    this.states = data.states.map(([tick, role, acting, state, because]) =>
      [tick, ...[role, acting, state, because].map((word) => match.words[word])]);
  }

  pose(tick) {
    const [x, y, heading] = this.track.at(tick);
    const trailer = this.trailer && this.trailer.at(tick);
    const head = this.head && this.head.at(tick);
    return { x, y, heading, trailer: trailer ? trailer[0] : null, head: head ? head[0] : 0 };
  }

  // The other robots that it believes in: team, x, y.
  othersBelieved(tick) {
    const look = lastUpTo(this.othersAt, tick);
    if (look < 0) return [];
    const robots = [];
    for (let i = this.othersFrom[look]; i < this.othersFrom[look + 1]; i += 2) {
      const x = this.others.at[i];
      const team = Math.abs(x % 2);
      robots.push({ team, x: (x - team) / 200, y: this.others.at[i + 1] / 100 });
    }
    return robots;
  }

  state(tick) {
    const [since, role, acting, state, because] = rowAt(this.states, tick) || this.states[0];
    return { since, role, acting, state, because };
  }

  has(sign, tick) {
    const row = rowAt(this.signs, tick);
    return Boolean(row && row[1] & sign);
  }
}

const SIGNS = { crashed: 1, frozen: 2, deaf: 4, mute: 8, off: 16, piloted: 32 };

class MatchReader {
  constructor(match) {
    Object.assign(this, match);
    const { place, heading } = match.exact;
    this.ballTrack = new Track(match.ball.track, [place[0], place[0]]);
    this.robots = match.robots.map((robot) => new Robot(robot, match));
    this.phaseRows = match.phases.map((phase) => [phase.tick, phase]);
    this.forks = match.forks.map((fork) => ({
      ...fork,
      ballTrack: new Track(fork.ball, [place[0], place[0]]),
      bodies: fork.robots.map((robot) => ({
        track: new Track(robot.track, [place[0], place[0], heading[0]]),
        trailer: robot.trailer && new Track(robot.trailer, [heading[0]]),
      })),
    }));
    this.messages = this.readMessages(match.messages);
    this.sentAt = Float64Array.from(this.messages, (message) => message.sent);
  }

  // The messages that were sent between two ticks.
  messagesSent(from, until) {
    return this.messages.slice(lastUpTo(this.sentAt, from - 1e-6) + 1, lastUpTo(this.sentAt, until) + 1);
  }

  readMessages(table) {
    const sent = summed(table.sent);
    return table.from.map((from, i) => ({
      from, to: table.to[i], sent: sent[i], arrives: sent[i] + table.took[i], kind: this.words[table.kind[i]],
      attempt: table.attempt[i], lost: table.lost[i] ? this.words[table.lost[i] - 1] : null, late: table.late[i] === 1,
    }));
  }

  seconds(tick) { return tick * this.dt; }

  phase(tick) {
    const { tick: since, phase, half, left, score } = (rowAt(this.phaseRows, tick) || this.phaseRows[0])[1];
    const passed = phase === "playing" ? this.seconds(tick - since) : 0;
    return { phase, half, left: left - passed, score };
  }

  // Where all bodies are at a tick, for the picture and for whoever reads the page by a program: m and rad.
  at(tick) {
    const [x, y] = this.ballTrack.at(tick);
    return { ball: { x, y }, robots: this.robots.map((robot) => ({ name: robot.name, ...robot.pose(tick) })) };
  }
}
