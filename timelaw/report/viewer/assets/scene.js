// What is drawn: the sphere with the traces of the body axes, the body as a box, ω as an arrow.

const STEP = (5 * Math.PI) / 180; // of the body's rotation between two points of a trace
const COARSE = 4; // points from one that is drawn to the next, of very many segments
const DEEPEST = 12; // halvings between them
const SPLITS = 4; // parts of a segment that are looked at in any case
const MANY = 60; // segments; traces of more are a ball of wool, and their far side is not dashed
const AROUND = 5; // segments before and after the present one that stand out of so many
const LIGHT = { axes: ["#b3261e", "#0b5fa5", "#1b6e3c"], omega: "#8a5200" };
const DARK = { axes: ["#ff8a7a", "#7fb8ff", "#74d99a"], omega: "#ffc061" };
const FACES = [0, 1, 2].flatMap((axis) => [[axis, 1], [axis, -1]]);

/** The column of R(q): where a body axis points in the world, from an offset on. */
function writeAxes(q, out, at) {
  const [w, x, y, z] = q;
  out[at] = w * w + x * x - y * y - z * z;
  out[at + 1] = 2 * (x * y + w * z);
  out[at + 2] = 2 * (x * z - w * y);
  out[at + 3] = 2 * (x * y - w * z);
  out[at + 4] = w * w - x * x + y * y - z * z;
  out[at + 5] = 2 * (y * z + w * x);
  out[at + 6] = 2 * (x * z + w * y);
  out[at + 7] = 2 * (y * z - w * x);
  out[at + 8] = w * w - x * x - y * y + z * z;
}

/** Points of the motion, close where it turns: times, body axes (9 each), places (3 each), by segment. */
function traceMotion(law) {
  const times = [], first = [];
  const look = (t) => {
    law.turnTo(t);
    return Float64Array.from(law.q);
  };
  const refine = (a, p, b, q, depth) => {
    const cosine = Math.min(Math.abs(dot(p, q)), 1);
    if (depth === DEEPEST || 2 * Math.acos(cosine) <= STEP) return;
    const middle = (a + b) / 2, between = look(middle);
    refine(a, p, middle, between, depth + 1);
    times.push(middle);
    refine(middle, between, b, q, depth + 1);
  };
  const splits = law.travels ? 8 * SPLITS : SPLITS;
  law.segments.forEach((segment, index) => {
    first.push(times.length);
    const begin = law.times[index], end = law.times[index + 1];
    let a = begin, p = segment.start;
    const count = segment.kind === "dwell" ? 1 : splits;
    for (let k = 1; k <= count; k++) {
      const b = k === count ? end : begin + ((end - begin) * k) / count;
      const q = k === count ? segment.end : look(b);
      times.push(a);
      refine(a, p, b, q, 0);
      [a, p] = [b, q];
    }
  });
  times.push(law.duration);
  first.push(times.length - 1);
  const axes = new Float32Array(9 * times.length), places = new Float32Array(law.travels ? 3 * times.length : 0);
  times.forEach((t, k) => {
    const tau = law.turnTo(t);
    writeAxes(law.q, axes, 9 * k);
    if (law.travels) {
      law.segment.move(tau, law.places);
      places.set(law.places[0], 3 * k);
    }
  });
  const coarse = times.map((_, k) => k).filter(thin(first));
  return { times: Float64Array.from(times), first: Int32Array.from(first), axes, places, coarse };
}

/** Whether a point is one of few: the first of a segment, or some points after the last that was. */
function thin(first) {
  let next = 0, since = 0;
  return (k) => {
    if (k === first[next]) next++;
    else if (++since < COARSE) return false;
    since = 0;
    return true;
  };
}

/** Whether the text of the page is light, and so its ground dark. */
function isDark(element) {
  const parts = getComputedStyle(element).color.match(/[\d.]+/g).map(Number);
  return 0.299 * parts[0] + 0.587 * parts[1] + 0.114 * parts[2] > 127;
}

/** What the sphere is drawn from and onto: a canvas, a view of two angles, colours of the page. */
class Canvas {
  constructor(element) {
    this.element = element;
    this.context = element.getContext("2d");
    this.azimuth = (35 * Math.PI) / 180;
    this.elevation = (22 * Math.PI) / 180;
    this.lookFrom();
  }

  /** The directions to the right, up and towards who looks, in the world. */
  lookFrom() {
    const [c, s, d, u] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation), Math.sin(this.elevation)];
    this.right = [-s, c, 0];
    this.up = [-u * c, -u * s, d];
    this.near = [d * c, d * s, u];
  }

  /** Takes the size of the page's element, and its colours. */
  fit() {
    const ratio = window.devicePixelRatio || 1, width = this.element.clientWidth;
    this.ratio = ratio;
    this.element.width = this.element.height = Math.max(Math.round(width * ratio), 1);
    this.size = width;
    this.radius = width * 0.43;
    this.dark = isDark(this.element);
    this.ink = getComputedStyle(this.element).color;
    this.paper = getComputedStyle(this.element).backgroundColor;
    this.colours = this.dark ? DARK : LIGHT;
  }

  /** Pixels of a direction times the sphere's radius: [x, y, depth]. */
  project(v, scale = 1) {
    const half = this.size / 2, r = this.radius * scale;
    return [half + r * dot(v, this.right), half - r * dot(v, this.up), dot(v, this.near)];
  }

  line(points, colour, width, { alpha = 1, dash = [] } = {}) {
    const c = this.context;
    c.globalAlpha = alpha;
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.setLineDash(dash);
    c.beginPath();
    points.forEach(([x, y], k) => (k ? c.lineTo(x, y) : c.moveTo(x, y)));
    c.stroke();
    c.globalAlpha = 1;
    c.setLineDash([]);
  }

  arrow(from, to, colour, width, label) {
    this.line([from, to], colour, width);
    const c = this.context, long = Math.hypot(to[0] - from[0], to[1] - from[1]);
    const size = Math.min(4 + 2 * width, long), angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
    c.fillStyle = colour;
    if (long > 1) {
      c.beginPath();
      c.moveTo(to[0], to[1]);
      for (const side of [-0.42, 0.42]) {
        c.lineTo(to[0] - size * Math.cos(angle + side), to[1] - size * Math.sin(angle + side));
      }
      c.fill();
    }
    c.font = "600 14px system-ui, 'DejaVu Sans', sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    if (long > 12) c.fillText(label, to[0] + 11 * Math.cos(angle), to[1] + 11 * Math.sin(angle));
  }
}

/** Great circles of the world, one half of them. */
function drawGlobe(canvas, front) {
  const c = canvas.context, half = canvas.size / 2;
  c.strokeStyle = canvas.ink;
  c.lineWidth = 1;
  c.globalAlpha = front ? 0.35 : 0;
  c.beginPath();
  c.arc(half, half, canvas.radius, 0, 2 * Math.PI);
  c.stroke();
  c.globalAlpha = front ? 0.16 : 0.08;
  c.beginPath();
  for (const degrees of [0, 30, 60, 90, 120, 150]) {
    const m = (degrees * Math.PI) / 180, p = ((degrees - 60) * Math.PI) / 180;
    drawRing(canvas, front, (a) => [Math.cos(a) * Math.cos(m), Math.cos(a) * Math.sin(m), Math.sin(a)]);
    if (degrees < 150) drawRing(canvas, front, (a) => [Math.cos(p) * Math.cos(a), Math.cos(p) * Math.sin(a), Math.sin(p)]);
  }
  c.stroke();
  c.globalAlpha = 1;
}

function drawRing(canvas, front, ring) {
  let last = false;
  for (let k = 0; k <= 72; k++) {
    const [x, y, depth] = canvas.project(ring((k * Math.PI) / 36));
    const here = depth >= 0 === front;
    if (here) canvas.context[last ? "lineTo" : "moveTo"](x, y);
    last = here;
  }
}

/** The trace of one body axis, near or far side, as one path; by all points, or by those that are `few`. */
function drawTrace(canvas, trace, axis, from, to, front, style, few) {
  const c = canvas.context, { axes } = trace, { right, up, near } = canvas;
  const half = canvas.size / 2, r = canvas.radius;
  Object.assign(c, style);
  c.setLineDash(style.dash ?? []);
  c.beginPath();
  let last = false, before = null;
  for (let n = from; n <= to; n++) {
    const at = 9 * (few ? few[n] : n) + 3 * axis, a = axes[at], b = axes[at + 1], d = axes[at + 2];
    const x = half + r * (a * right[0] + b * right[1]);
    const y = half - r * (a * up[0] + b * up[1] + d * up[2]);
    const here = a * near[0] + b * near[1] + d * near[2] >= 0 === front;
    if (here && !last) before ? (c.moveTo(before[0], before[1]), c.lineTo(x, y)) : c.moveTo(x, y);
    else if (here) c.lineTo(x, y);
    last = here;
    before = here ? null : [x, y];
  }
  c.stroke();
  c.setLineDash([]);
  c.globalAlpha = 1;
}

/** The nodes on the traces: discs on the near side, rings on the far side. */
function drawNodes(canvas, trace, from, to, front) {
  const c = canvas.context;
  for (let axis = 0; axis < 3; axis++) {
    c.fillStyle = c.strokeStyle = canvas.colours.axes[axis];
    c.lineWidth = 1;
    c.globalAlpha = front ? 1 : 0.5;
    for (let k = from; k <= to; k++) {
      const at = 9 * trace.first[k] + 3 * axis;
      const [x, y, depth] = canvas.project(trace.axes.subarray(at, at + 3));
      if (depth >= 0 !== front) continue;
      c.beginPath();
      c.arc(x, y, front ? 3.2 : 2.6, 0, 2 * Math.PI);
      c[front ? "fill" : "stroke"]();
    }
  }
  c.globalAlpha = 1;
}
