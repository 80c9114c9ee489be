// Vectors of three numbers, and matrices of three columns.

/** @typedef {[number, number, number]} Vec */

/** @param {Vec} a @param {Vec} b @returns {Vec} */
export const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

/** @param {Vec} a @param {Vec} b @returns {Vec} */
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** @param {number} s @param {Vec} a @returns {Vec} */
export const times = (s, a) => [s * a[0], s * a[1], s * a[2]];

/** Return the product of two colours. @param {Vec} a @param {Vec} b @returns {Vec} */
export const eachTimes = (a, b) => [a[0] * b[0], a[1] * b[1], a[2] * b[2]];

/** @param {Vec} a @param {Vec} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** @param {Vec} a @param {Vec} b @returns {Vec} */
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** @param {Vec} a */
export const length = (a) => Math.sqrt(dot(a, a));

/** @param {Vec} a @returns {Vec} */
export const normalized = (a) => times(1 / length(a), a);

/** @param {Vec} a */
export const isZero = (a) => a[0] === 0 && a[1] === 0 && a[2] === 0;

/** Return a point of the segment from a to b. @param {number} s @param {Vec} a @param {Vec} b */
export const between = (s, a, b) => plus(times(1 - s, a), times(s, b));

/**
 * Return the rows of the inverse of the matrix with columns u, v, w: the coordinates of a vector
 * are its dot products with them.
 * @param {Vec} u @param {Vec} v @param {Vec} w @returns {[Vec, Vec, Vec]}
 */
export function inverseRows(u, v, w) {
  const volume = dot(u, cross(v, w));
  return [
    times(1 / volume, cross(v, w)),
    times(1 / volume, cross(w, u)),
    times(1 / volume, cross(u, v)),
  ];
}

/**
 * Return a vector turned about a unit axis. Source: Rodrigues' rotation formula.
 * @param {Vec} a @param {Vec} axis @param {number} angle in radians @returns {Vec}
 */
export function rotated(a, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return plus(plus(times(c, a), times(s, cross(axis, a))), times((1 - c) * dot(axis, a), axis));
}
