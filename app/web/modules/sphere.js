// Ray and sphere. Source: Haines, Günther and Akenine-Möller, Precision Improvements for
// Ray/Sphere Intersection, Ray Tracing Gems (2019), chapter 7.

import { dot, minus, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */

/**
 * Return the least t with tMin < t < tMax; NaN if the ray misses. A tangent ray hits.
 * @param {ArrayLike<number>} spheres centre and radius from number `at` on @param {number} at
 * @param {Vec} origin @param {Vec} direction @param {number} tMin @param {number} tMax
 */
export function closestSphere(spheres, at, origin, direction, tMin, tMax) {
  const radius = spheres[at + 3];
  const f = minus(origin, [spheres[at], spheres[at + 1], spheres[at + 2]]);
  const a = dot(direction, direction), b = -dot(f, direction);
  // The ray's point nearest to the centre tells whether it passes through.
  const nearest = plus(f, times(b / a, direction));
  const leftOver = radius * radius - dot(nearest, nearest);
  if (leftOver < 0) return NaN;
  // The root of larger magnitude first; the other follows without cancellation.
  const q = b + (b < 0 ? -1 : 1) * Math.sqrt(a * leftOver);
  if (q === 0) return NaN;
  const one = (dot(f, f) - radius * radius) / q, other = q / a;
  const first = Math.min(one, other), second = Math.max(one, other);
  if (tMin < first && first < tMax) return first;
  return tMin < second && second < tMax ? second : NaN;
}
