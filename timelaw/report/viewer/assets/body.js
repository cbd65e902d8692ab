// The body and its way: a box with coloured axes, at the centre of the sphere or where it is in space.

const WOOL = 20; // opaque lines that the traces of very many segments amount to, as many as there may be
const EXTENT = 0.56; // half the box's diagonal, of the sphere's radius

/** The three half edges as vectors of the world. */
function halfEdges(axes, at, half) {
  return [0, 1, 2].map((i) => [0, 1, 2].map((j) => axes[at + 3 * i + j] * half[i]));
}

/** Faces of the box that are seen, each with its light; `centre` and the half edges in the world. */
function drawBox(canvas, place, edges) {
  const c = canvas.context;
  for (const [axis, sign] of FACES) {
    const normal = edges[axis].map((part) => (sign * part) / Math.hypot(...edges[axis]));
    const facing = dot(normal, canvas.near);
    if (facing <= 0) continue;
    const [u, v] = [edges[(axis + 1) % 3], edges[(axis + 2) % 3]];
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) =>
      place(edges[axis].map((part, i) => sign * part + a * u[i] + b * v[i])));
    c.beginPath();
    corners.forEach(([x, y], k) => (k ? c.lineTo(x, y) : c.moveTo(x, y)));
    c.closePath();
    c.fillStyle = canvas.paper;
    c.fill();
    c.globalAlpha = sign > 0 ? 0.25 + 0.35 * facing : 0.06 + 0.16 * facing;
    c.fillStyle = sign > 0 ? canvas.colours.axes[axis] : canvas.ink;
    c.fill();
    c.globalAlpha = 0.9;
    c.strokeStyle = canvas.ink;
    c.lineWidth = 1;
    c.lineJoin = "round";
    c.stroke();
    c.globalAlpha = 1;
  }
}

/** The body with its axes, those that point away drawn before it; `reach` is their length. */
function drawBody(canvas, place, axes, at, half, reach) {
  const edges = halfEdges(axes, at, half);
  const draw = (front) => {
    for (let i = 0; i < 3; i++) {
      const axis = [axes[at + 3 * i], axes[at + 3 * i + 1], axes[at + 3 * i + 2]];
      if (dot(axis, canvas.near) >= 0 !== front) continue;
      canvas.arrow(place(edges[i]), place(axis.map((part) => part * reach)), canvas.colours.axes[i], 2, "xyz"[i]);
    }
  };
  draw(false);
  drawBox(canvas, place, edges);
  draw(true);
}

/** The angular velocity, as seen from the world, its greatest as long as is said. */
function drawOmega(canvas, law, place, long) {
  const tip = turn(law.q, law.rates[1], [0, 0, 0], false).map((part) => (long * part) / law.fastest);
  if (Math.hypot(...tip) > 0.01 * long) canvas.arrow(place([0, 0, 0]), place(tip), canvas.colours.omega, 3, "ω");
}

/** The picture of the orientation, between both halves of the sphere. */
class Sphere {
  constructor(law, trace, shape) {
    Object.assign(this, { law, trace });
    const size = Math.hypot(...shape);
    this.half = shape.map((edge) => (EXTENT * edge) / size);
    this.layers = [false, true].map((front) => ({ front, image: document.createElement("canvas") }));
    this.kept = false;
    this.axes = new Float32Array(9);
  }

  /** What only changes with the view, one half; the far one is fainter, and dashed where that is to be seen. */
  drawHalf(canvas, front) {
    const { trace, law } = this, many = law.segments.length > MANY;
    drawGlobe(canvas, front);
    const few = many ? trace.coarse : null, last = (few ?? trace.times).length - 1;
    for (let axis = 0; axis < 3; axis++) {
      drawTrace(canvas, trace, axis, 0, last, front, {
        strokeStyle: canvas.colours.axes[axis], lineWidth: many ? 1 / canvas.ratio : 1.3,
        globalAlpha: (many ? WOOL / law.segments.length : 0.75) * (front ? 1 : 0.5), dash: front || many ? [] : [4, 3],
      }, few);
    }
    if (!many) drawNodes(canvas, trace, 0, law.segments.length, front);
  }

  /** Both halves as images, for views that stay: drawn into a frame they would cost the more the longer the law. */
  keep(canvas) {
    for (const { front, image } of this.layers) {
      image.width = image.height = canvas.element.width;
      const context = image.getContext("2d");
      context.setTransform(canvas.ratio, 0, 0, canvas.ratio, 0, 0);
      this.drawHalf(Object.create(canvas, { context: { value: context } }), front);
    }
  }

  /** `turned` is whether the view is another than in the picture before. */
  draw(canvas, t, turned) {
    const { law } = this, c = canvas.context, place = (v) => canvas.project(v);
    if (!turned && !this.kept) this.keep(canvas);
    this.kept = !turned;
    const half = (front) => this.kept ? c.drawImage(this.layers[Number(front)].image, 0, 0, canvas.size, canvas.size) : this.drawHalf(canvas, front);
    writeAxes(law.q, this.axes, 0);
    half(false);
    this.drawTrail(canvas, t, false);
    drawBody(canvas, place, this.axes, 0, this.half, 1);
    drawOmega(canvas, law, place, 0.95);
    half(true);
    this.drawTrail(canvas, t, true);
  }

  /** The way just gone, stronger; of very many segments also those around, and their nodes. */
  drawTrail(canvas, t, front) {
    const { law, trace } = this, last = law.segments.length, many = last > MANY;
    const from = trace.first[Math.max(law.index - (many ? AROUND : 1), 0)];
    const to = trace.first[Math.min(law.index + AROUND, last)];
    let now = trace.first[law.index];
    while (now < trace.times.length - 1 && trace.times[now + 1] <= t) now++;
    for (let axis = 0; axis < 3; axis++) {
      const style = { strokeStyle: canvas.colours.axes[axis], dash: [] };
      if (many) {
        const ahead = { ...style, lineWidth: 1.2, globalAlpha: front ? 0.6 : 0.3 };
        drawTrace(canvas, trace, axis, now, to, front, ahead);
      }
      drawTrace(canvas, trace, axis, from, now, front, { ...style, lineWidth: 2.4, globalAlpha: front ? 1 : 0.5 });
      this.drawLast(canvas, now, axis, front);
    }
    if (many) drawNodes(canvas, trace, Math.max(law.index - AROUND, 0), Math.min(law.index + AROUND, last), front);
  }

  /** From the last point of the trace to where the axis is now. */
  drawLast(canvas, now, axis, front) {
    const at = 9 * now + 3 * axis, here = this.axes.subarray(3 * axis, 3 * axis + 3);
    if (dot(here, canvas.near) >= 0 !== front) return;
    const ends = [canvas.project(this.trace.axes.subarray(at, at + 3)), canvas.project(here)];
    canvas.line(ends, canvas.colours.axes[axis], 2.4, { alpha: front ? 1 : 0.5 });
  }
}

/** The picture of a body that travels: its way through space, and the box where it is. */
class Space {
  constructor(law, trace, shape) {
    Object.assign(this, { law, trace });
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    trace.places.forEach((part, k) => {
      low[k % 3] = Math.min(low[k % 3], part);
      high[k % 3] = Math.max(high[k % 3], part);
    });
    this.middle = low.map((part, i) => (part + high[i]) / 2);
    this.half = shape.map((edge) => edge / 2);
    this.reach = trace.times.reduce((most, _, k) => Math.max(most, this.measure(k)), 0) + Math.hypot(...this.half);
    this.axes = new Float32Array(9);
  }

  /** How far a point of the way is from the middle. */
  measure(k) {
    return Math.hypot(...this.middle.map((part, i) => this.trace.places[3 * k + i] - part));
  }

  draw(canvas) {
    const { law, trace, middle, reach } = this;
    const place = (v) => canvas.project(v.map((part, i) => (part - middle[i]) / reach));
    this.drawFloor(canvas, place);
    const way = [], { places, times } = trace;
    for (let k = 0; k < times.length; k++) way.push(place([places[3 * k], places[3 * k + 1], places[3 * k + 2]]));
    canvas.line(way, canvas.ink, 1.2, { alpha: 0.7 });
    const c = canvas.context;
    c.fillStyle = canvas.ink;
    for (const k of trace.first) {
      c.beginPath();
      c.arc(way[k][0], way[k][1], 3, 0, 2 * Math.PI);
      c.fill();
    }
    writeAxes(law.q, this.axes, 0);
    const here = law.places[0], long = 0.3 * reach + Math.max(...this.half);
    const from = (v) => place(v.map((part, i) => part + here[i]));
    drawBody(canvas, from, this.axes, 0, this.half, long);
    drawOmega(canvas, law, from, long);
    this.drawScale(canvas);
  }

  /** How long a length of the picture is. */
  drawScale(canvas) {
    const c = canvas.context, power = 10 ** Math.floor(Math.log10(this.reach / 2));
    const long = power * [5, 2, 1].find((part) => part * power <= this.reach / 2), y = canvas.size - 14;
    canvas.line([[14, y], [14 + (long * canvas.radius) / this.reach, y]], canvas.ink, 2);
    c.fillStyle = canvas.ink;
    c.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    c.textAlign = "left";
    c.fillText(`${Number(long.toPrecision(1))} m`, 14, y - 10);
  }

  /** The axes of the world, from the middle of what is shown. */
  drawFloor(canvas, place) {
    for (let i = 0; i < 3; i++) {
      const end = this.middle.map((part, j) => part + (i === j ? 0.9 * this.reach : 0));
      const start = this.middle.map((part, j) => part - (i === j ? 0.9 * this.reach : 0));
      canvas.line([place(start), place(end)], canvas.ink, 1, { alpha: 0.25 });
      const c = canvas.context, [x, y] = place(end);
      c.fillStyle = canvas.ink;
      c.globalAlpha = 0.6;
      c.font = "12px system-ui, 'DejaVu Sans', sans-serif";
      c.fillText("XYZ"[i], x + 6, y - 6);
      c.globalAlpha = 1;
    }
  }
}
