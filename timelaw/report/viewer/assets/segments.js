// Kinds of segment, each from its own numbers as the law file has them: q, ω, α, jerk, snap, place.
// `numbers` are doubles bit for bit; a segment's record begins at its offset, pieces of equal ones stand once.

const HIGHEST = 4; // of the rates: snap
const BINOMIAL = [[1], [1, 1], [1, 2, 1], [1, 3, 3, 1], [1, 4, 6, 4, 1]];
const work = new Float64Array(256); // of de Casteljau; no piece has so many control points

/** p(u) of the first `count` control points in `work`, which are overwritten. */
function collapse(count, u) {
  for (let n = count - 1; n > 0; n--) {
    for (let i = 0; i < n; i++) work[i] = (1 - u) * work[i] + u * work[i + 1];
  }
  return work[0];
}

/** The k-th derivative at u of the polynomial in `count` control points, `stride` apart from `from` on. */
function derive(numbers, from, count, stride, order, u, duration) {
  if (order >= count) return 0;
  for (let i = 0; i < count; i++) work[i] = numbers[from + i * stride];
  let factor = 1;
  for (let k = 0, degree = count - 1; k < order; k++, degree--) {
    for (let i = 0; i < degree; i++) work[i] = work[i + 1] - work[i];
    factor *= degree / duration;
  }
  return factor * collapse(count - order, u);
}

/** Hamilton's product of two quaternions. */
function multiply(p, q, out) {
  const [a, b, c, d] = p, [w, x, y, z] = q;
  out[0] = a * w - b * x - c * y - d * z;
  out[1] = a * x + b * w + c * z - d * y;
  out[2] = a * y - b * z + c * w + d * x;
  out[3] = a * z + b * y - c * x + d * w;
}

/** A vector over its norm. */
function normalise(vector) {
  const size = Math.hypot(...vector);
  return vector.map((part) => part / size);
}

/** Which piece holds τ, and where in it: [piece, u]; a break belongs to the piece after it. */
function locate(track, tau) {
  const { breaks, count } = track;
  let low = 0, high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (breaks[middle] <= tau) low = middle;
    else high = middle - 1;
  }
  const long = breaks[low + 1] - breaks[low];
  const u = tau <= breaks[low] ? 0 : tau >= breaks[low + 1] ? 1 : (tau - breaks[low]) / long;
  return [low, Math.min(Math.max(u, 0), 1)];
}

/** Pieces from an offset on: how many, two counts of rows, then each piece's duration and its rows.

    Where the counts are not those of all pieces they are zero, and each piece has its own after its duration. */
function readTrack(numbers, offset, width, otherWidth) {
  const count = numbers[offset], alike = numbers[offset + 1] + numbers[offset + 2] > 0, places = [];
  const breaks = new Float64Array(count + 1);
  let at = offset + 3;
  for (let k = 0; k < count; k++) {
    const counts = alike ? offset + 1 : at + 1, rows = numbers[counts], others = numbers[counts + 1];
    const from = at + (alike ? 1 : 3);
    places.push({ duration: numbers[at], rows, others, from, next: from + width * rows });
    breaks[k + 1] = breaks[k] + numbers[at];
    at = from + width * rows + otherWidth * others;
  }
  const total = breaks[count];
  for (let k = 1; k < count; k++) breaks[k] /= total;
  breaks[count] = 1;
  return { count, places, breaks };
}

/** The k-th derivative of the angle: its state at a piece's start, and the next derivative integrated. */
function integrateAngle(numbers, piece, order, u) {
  const { duration, rows, others, from, next } = piece;
  if (order >= rows) return derive(numbers, next, others, 1, order - rows, u, duration);
  let count = others;
  for (let i = 0; i < count; i++) work[i] = numbers[next + i];
  for (let level = rows - 1; level >= order; level--) {
    let sum = numbers[from + level];
    for (let i = 0; i < count; i++) {
      const step = (work[i] * duration) / count;
      work[i] = sum;
      sum += step;
    }
    work[count++] = sum;
  }
  return collapse(count, u);
}

/** A great-circle arc: q = q_i ⊗ (cos(φ/2), n sin(φ/2)). */
function readArc(numbers, offset, tracks) {
  const start = normalise(numbers.slice(offset, offset + 4));
  const end = normalise(numbers.slice(offset + 4, offset + 8));
  const axis = normalise(numbers.slice(offset + 8, offset + 11));
  const track = tracks(numbers[offset + 11], 1, 1), turn = new Float64Array(4);
  return {
    start, end,
    turnTo(tau, q) {
      const [piece, u] = locate(track, tau);
      const half = integrateAngle(numbers, track.places[piece], 0, u) / 2;
      turn[0] = Math.cos(half);
      for (let i = 0; i < 3; i++) turn[i + 1] = axis[i] * Math.sin(half);
      multiply(start, turn, q);
    },
    rate(tau, rates) {
      const [piece, u] = locate(track, tau);
      for (let k = 1; k <= HIGHEST; k++) {
        const size = integrateAngle(numbers, track.places[piece], k, u);
        for (let i = 0; i < 3; i++) rates[k][i] = size * axis[i];
      }
    },
    move() {},
  };
}

/** The body rests at a node. */
function readDwell(numbers, offset) {
  const start = normalise(numbers.slice(offset, offset + 4)), point = numbers.slice(offset + 4, offset + 7);
  return {
    start, end: start,
    turnTo(tau, q) { q.set(start); },
    rate(tau, rates) { for (let k = 1; k <= HIGHEST; k++) rates[k].fill(0); },
    move(tau, places) {
      places[0].set(point);
      places[1].fill(0);
      places[2].fill(0);
    },
  };
}

/** A rational segment: orientation Q/|Q|, place P/|Q|², both Q and P polynomials in time [HZ2019]. */
function readRational(numbers, offset, tracks) {
  const start = normalise(numbers.slice(offset, offset + 4));
  const end = normalise(numbers.slice(offset + 4, offset + 8));
  const track = tracks(numbers[offset + 8], 4, 3);
  const curve = Array.from({ length: HIGHEST + 1 }, () => new Float64Array(4));
  const square = new Float64Array(HIGHEST + 1);

  function deriveCurve({ duration, rows, from }, highest, u) {
    for (let k = 0; k <= highest; k++) {
      for (let i = 0; i < 4; i++) curve[k][i] = derive(numbers, from + i, rows, 4, k, u, duration);
    }
    for (let k = 0; k <= highest; k++) {
      square[k] = 0;
      for (let i = 0; i <= k; i++) {
        let dot = 0;
        for (let j = 0; j < 4; j++) dot += curve[i][j] * curve[k - i][j];
        square[k] += BINOMIAL[k][i] * dot;
      }
    }
  }

  /** Adds 2 times a multiple of Vec(ā b). */
  function addVector(a, b, times, out) {
    out[0] += 2 * times * (a[0] * b[1] - a[1] * b[0] - a[2] * b[3] + a[3] * b[2]);
    out[1] += 2 * times * (a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1]);
    out[2] += 2 * times * (a[0] * b[3] - a[1] * b[2] + a[2] * b[1] - a[3] * b[0]);
  }

  /** found[k] D = its numerator's derivative less what lower ones and those of D make, by Leibniz' rule. */
  function divide(found, first, k) {
    for (let i = 0; i < k; i++) {
      for (let j = 0; j < 3; j++) found[first + k][j] -= BINOMIAL[k][i] * found[first + i][j] * square[k - i];
    }
    for (let j = 0; j < 3; j++) found[first + k][j] /= square[0];
  }

  return {
    start, end,
    turnTo(tau, q) {
      const [piece, u] = locate(track, tau);
      deriveCurve(track.places[piece], 0, u);
      const size = Math.sqrt(square[0]);
      for (let i = 0; i < 4; i++) q[i] = curve[0][i] / size;
    },
    rate(tau, rates) {
      const [piece, u] = locate(track, tau);
      deriveCurve(track.places[piece], HIGHEST, u);
      for (let k = 0; k < HIGHEST; k++) {
        rates[k + 1].fill(0);
        for (let i = 0; i <= k; i++) addVector(curve[i], curve[k - i + 1], BINOMIAL[k][i], rates[k + 1]);
        divide(rates, 1, k);
      }
    },
    move(tau, places) {
      const [piece, u] = locate(track, tau), { duration, others, next } = track.places[piece];
      deriveCurve(track.places[piece], 2, u);
      for (let k = 0; k <= 2; k++) {
        for (let j = 0; j < 3; j++) places[k][j] = derive(numbers, next + j, others, 3, k, u, duration);
        divide(places, 0, k);
      }
    },
  };
}

const KINDS = {
  arc: readArc,
  dwell: readDwell,
  rational: readRational,
};
