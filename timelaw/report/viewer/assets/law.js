// The law: which segment holds a time, the state of the body there, and what of the limits is used.

/** R(q)ᵀ v or R(q) v: a vector seen from the body, or from the world. */
function turn(q, v, out, back) {
  const w = back ? -q[0] : q[0], [, x, y, z] = q;
  const a = 2 * (y * v[2] - z * v[1]), b = 2 * (z * v[0] - x * v[2]), c = 2 * (x * v[1] - y * v[0]);
  out[0] = v[0] + w * a + y * c - z * b;
  out[1] = v[1] + w * b + z * a - x * c;
  out[2] = v[2] + w * c + x * b - y * a;
  return out;
}

function cross(u, v) {
  return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
}

function dot(u, v) {
  let sum = 0;
  for (let i = 0; i < u.length; i++) sum += u[i] * v[i];
  return sum;
}

/** The angle of the body to the closed arc of its leg, from `start` to `end` [rad]. */
function measureDeviation(q, start, end) {
  const cosine = dot(start, end);
  const first = normalise(end.map((part, i) => part - cosine * start[i]));
  const last = end.map((part, i) => cosine * part - start[i]);
  const along = dot(q, start), ahead = dot(q, first), beyond = dot(q, normalise(last));
  let square = 0;
  for (let i = 0; i < 4; i++) square += (q[i] - along * start[i] - ahead * first[i]) ** 2;
  if (ahead < 0) square += ahead ** 2;
  if (beyond > 0) square += beyond ** 2;
  return 2 * Math.asin(Math.min(Math.sqrt(square), 1));
}

/** What each limit bounds, as a vector of three, or as a number. */
const LIMITED = {
  velocity: (law) => law.rates[1],
  acceleration: (law) => law.rates[2],
  jerk: (law) => law.rates[3],
  snap: (law) => law.rates[4],
  torque: (law) => {
    const { inertia, wheels } = law.body, [, omega, alpha] = law.rates;
    const drift = cross(omega, wheels ? law.seeMomentum() : inertia.map((row) => dot(row, omega)));
    return inertia.map((row, i) => dot(row, alpha) + drift[i]);
  },
  momentum: (law) => {
    const total = law.seeMomentum();
    return law.body.inertia.map((row, i) => total[i] - dot(row, law.rates[1]));
  },
  linear_velocity: (law) => law.places[1],
  linear_acceleration: (law) => law.places[2],
  deviation: (law) => measureDeviation(law.q, law.segment.start, law.segment.end),
};

class Law {
  /** `data` as the page holds it; numbers are doubles in base 64. */
  constructor(data) {
    const bytes = Uint8Array.from(atob(data.numbers), (letter) => letter.charCodeAt(0));
    const numbers = new Float64Array(bytes.buffer), known = new Map();
    const tracks = (offset, ...widths) => {
      if (!known.has(offset)) known.set(offset, readTrack(numbers, offset, ...widths));
      return known.get(offset);
    };
    this.segments = data.segments.map(([kind, offset]) => ({
      kind: data.kinds[kind],
      begin: numbers[offset],
      duration: numbers[offset + 1],
      ...KINDS[data.kinds[kind]](numbers, offset + 2, tracks),
    }));
    this.times = Float64Array.from([...this.segments.map((s) => s.begin), data.duration]);
    this.duration = data.duration;
    this.labels = data.labels;
    this.travels = data.travels;
    this.limits = data.limits;
    this.body = data.body;
    this.q = new Float64Array(4);
    this.rates = Array.from({ length: HIGHEST + 1 }, () => new Float64Array(3));
    this.places = Array.from({ length: 3 }, () => new Float64Array(3));
    this.moveTo(0);
    this.total = this.body ? turn(this.q, this.body.momentum, [0, 0, 0], false) : null;
  }

  /** The number of the segment that holds a time; a node belongs to the segment after it. */
  find(t) {
    let low = 0, high = this.segments.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Sets q, the rates and places to those at a time. */
  moveTo(t) {
    const tau = this.turnTo(t);
    this.segment.rate(tau, this.rates);
    if (this.travels) this.segment.move(tau, this.places);
  }

  /** Sets q alone. */
  turnTo(t) {
    this.index = this.find(t);
    this.segment = this.segments[this.index];
    const end = this.times[this.index + 1];
    const tau = t >= end ? 1 : Math.min(Math.max((t - this.segment.begin) / this.segment.duration, 0), 1);
    this.segment.turnTo(tau, this.q);
    return tau;
  }

  /** The total angular momentum in body axes. */
  seeMomentum() {
    return turn(this.q, this.total, [0, 0, 0], true);
  }

  /** The size of what a limit bounds now, and its bound here, this leg's own too; nothing where it has none. */
  measure(limit) {
    const bound = Math.min(limit.bound ?? Infinity, limit.own[this.index] ?? Infinity);
    if (bound === Infinity) return null;
    const value = LIMITED[limit.name](this);
    if (typeof value === "number") return [value, bound];
    return [limit.axis === null ? Math.hypot(...value) : Math.abs(value[limit.axis]), bound];
  }

  /** What the segment is called. */
  get name() {
    const from = this.labels[this.index], to = this.labels[this.index + 1];
    return this.segment.kind === "dwell" ? `rest at node ${to}` : `node ${from} to ${to}`;
  }
}
