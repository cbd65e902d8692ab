"""The fixed parts of the C99 source: what evaluates the tables."""

HEADER = """\
/* {title}: {segments} segments, {duration} s.
 *
 * Quaternions are scalar first (w, x, y, z), Hamilton, active, body to world: r_world = R(q) r_body.
 * Angular velocity omega [rad/s] and acceleration alpha [rad/s^2] are in body axes. At a node they are
 * those just after it. Times outside the motion are taken to its ends.
 *
 * No allocation, no state. {bytes} bytes of tables; a call takes at most {operations} multiplications and
 * additions, {comparisons} comparisons, {functions}.
 */
#ifndef {guard}
#define {guard}

#ifdef __cplusplus
extern "C" {{
#endif

#define {prefix}_DURATION {duration}{suffix}

void {name}_evaluate({real} t, {real} q[4], {real} omega[3], {real} alpha[3]);
{place}
#ifdef __cplusplus
}}
#endif

#endif
"""
PLACE_DECLARATION = """\

/* Place [m] and velocity [m/s] of the body's origin in the world. */
void {name}_place({real} t, {real} place[3], {real} velocity[3]);
"""

TYPES = """\
#include "{header}"

#include <math.h>

typedef {real} real;

enum {{ MOST_POINTS = {most} }};

/* A polynomial's degree and where its control points begin, for a function and its time derivatives. */
typedef struct {{
    real start, length; /* s, from the segment's start */
    int degree[{orders}];
    int first[{orders}];
}} piece_t;
"""

BERNSTEIN = """\

/* The last of `count` values, in order, that is not above `t`. */
static int find(const real *values, int count, real t)
{
    int low = 0, high = count;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (values[middle] <= t) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static int find_piece(int first, int end, real t)
{
    int low = first, high = end;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (pieces[middle].start <= t) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/* A vector polynomial in Bernstein form at u, by de Casteljau. */
static void bernstein(const real *control, int degree, int width, real u, real *value)
{
    real work[MOST_POINTS];
    int i, level;
    for (i = 0; i < (degree + 1) * width; ++i) {
        work[i] = control[i];
    }
    for (level = degree; level > 0; --level) {
        for (i = 0; i < level * width; ++i) {
            work[i] = (1 - u) * work[i] + u * work[i + width];
        }
    }
    for (i = 0; i < width; ++i) {
        value[i] = work[i];
    }
}

static real limit(real value, real least, real most)
{
    return value > least ? (value < most ? value : most) : least;
}
"""

TURN = """\

/* About a fixed axis: q = start (cos(phi/2), n sin(phi/2)). */
static void evaluate_turn(int segment, const piece_t *piece, real u, real *q, real *omega, real *alpha)
{
    const real *p = starts[segment], *n = axes[segment];
    real phi[3], c, s;
    int i;
    for (i = 0; i < 3; ++i) {
        bernstein(control + piece->first[i], piece->degree[i], 1, u, phi + i);
    }
    c = COS(phi[0] / 2);
    s = SIN(phi[0] / 2);
    q[0] = p[0] * c - s * (p[1] * n[0] + p[2] * n[1] + p[3] * n[2]);
    q[1] = p[1] * c + s * (p[0] * n[0] + p[2] * n[2] - p[3] * n[1]);
    q[2] = p[2] * c + s * (p[0] * n[1] - p[1] * n[2] + p[3] * n[0]);
    q[3] = p[3] * c + s * (p[0] * n[2] + p[1] * n[1] - p[2] * n[0]);
    for (i = 0; i < 3; ++i) {
        omega[i] = phi[1] * n[i];
        alpha[i] = phi[2] * n[i];
    }
}
"""

CURVE = """\

/* The vector part of conj(a) b. */
static void turn_rate(const real *a, const real *b, real *v)
{
    v[0] = a[0] * b[1] - a[1] * b[0] - a[2] * b[3] + a[3] * b[2];
    v[1] = a[0] * b[2] - a[2] * b[0] - a[3] * b[1] + a[1] * b[3];
    v[2] = a[0] * b[3] - a[3] * b[0] - a[1] * b[2] + a[2] * b[1];
}

/* A quaternion polynomial Q over its length, and its rates. */
static void evaluate_curve(const piece_t *piece, real u, real *q, real *omega, real *alpha)
{
    real w[3][4], square = 0, slope = 0, size;
    int i;
    for (i = 0; i < 3; ++i) {
        bernstein(control + piece->first[i], piece->degree[i], 4, u, w[i]);
    }
    for (i = 0; i < 4; ++i) {
        square += w[0][i] * w[0][i];
        slope += 2 * w[0][i] * w[1][i];
    }
    size = SQRT(square);
    for (i = 0; i < 4; ++i) {
        q[i] = w[0][i] / size;
    }
    turn_rate(w[0], w[1], omega);
    turn_rate(w[0], w[2], alpha);
    for (i = 0; i < 3; ++i) {
        omega[i] = 2 * omega[i] / square;
        alpha[i] = (2 * alpha[i] - slope * omega[i]) / square;
    }
}
"""

EVALUATE = """\

void {name}_evaluate(real t, real q[4], real omega[3], real alpha[3])
{{
    const real at = limit(t, 0, times[SEGMENTS]);
    const int segment = find(times, SEGMENTS, at);
    const real past = at - times[segment];
    const piece_t *piece = pieces + find_piece(first_piece[segment], first_piece[segment + 1], past);
    const real u = limit((past - piece->start) / piece->length, 0, 1);
{choose}}}
"""
CHOOSE = {
    (True, False): "    evaluate_turn(segment, piece, u, q, omega, alpha);\n",
    (False, True): "    evaluate_curve(piece, u, q, omega, alpha);\n",
    (True, True): """\
    if (curved[segment]) {
        evaluate_curve(piece, u, q, omega, alpha);
    } else {
        evaluate_turn(segment, piece, u, q, omega, alpha);
    }
""",
}

PLACE = """\

/* c = P/|Q|^2, or a point at rest. */
void {name}_place(real t, real place[3], real velocity[3])
{{
    const real at = limit(t, 0, times[SEGMENTS]);
    const int segment = find(times, SEGMENTS, at);
    const real past = at - times[segment];
    const piece_t *piece = pieces + find_piece(first_piece[segment], first_piece[segment + 1], past);
    const real u = limit((past - piece->start) / piece->length, 0, 1);
    real q[4] = {{1, 0, 0, 0}}, v[4] = {{0, 0, 0, 0}}, square = 0, slope = 0;
    int i;
    if (curved[segment]) {{
        bernstein(control + piece->first[0], piece->degree[0], 4, u, q);
        bernstein(control + piece->first[1], piece->degree[1], 4, u, v);
    }}
    bernstein(control + piece->first[3], piece->degree[3], 3, u, place);
    bernstein(control + piece->first[4], piece->degree[4], 3, u, velocity);
    for (i = 0; i < 4; ++i) {{
        square += q[i] * q[i];
        slope += 2 * q[i] * v[i];
    }}
    for (i = 0; i < 3; ++i) {{
        place[i] = place[i] / square;
        velocity[i] = (velocity[i] - slope * place[i]) / square;
    }}
}}
"""
