// The camera in the user's hands: orbit, pan and zoom. Each returns another camera.

import { isParallel } from "./camera.js";
import { dot, length, minus, normalized, plus, rotated, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./camera.js").Camera} Camera */

const UP = /** @type {Vec} */ ([0, 1, 0]);
const STEEPEST = 0.999; // how nearly along UP a camera may look

/** Return the point in front of the eye that is as far as the middle of the scene. @param {Camera} camera @param {Vec} middle @returns {Vec} */
export function pivotOf({ eye, w }, middle) {
  const ahead = times(-1, normalized(w)), far = dot(minus(middle, eye), ahead);
  return plus(eye, times(Math.max(far, 0.1 * length(minus(middle, eye)), 1e-6), ahead));
}

/** Turn the camera about a pivot. @param {Camera} camera @param {Vec} pivot @param {number} across @param {number} up angles in radians @returns {Camera} */
export function orbited(camera, pivot, across, up) {
  const turned = turnedAbout(camera, pivot, UP, across);
  const tilted = turnedAbout(turned, pivot, normalized(turned.u), up);
  return Math.abs(dot(normalized(tilted.w), UP)) < STEEPEST ? tilted : turned;
}

/** @param {Camera} camera @param {Vec} pivot @param {Vec} axis @param {number} angle @returns {Camera} */
function turnedAbout(camera, pivot, axis, angle) {
  /** @param {Vec} a */
  const turn = (a) => rotated(a, axis, angle);
  return { ...camera, eye: plus(pivot, turn(minus(camera.eye, pivot))), u: turn(camera.u), v: turn(camera.v), w: turn(camera.w) };
}

/** Move the eye along u and v so that the pivot's plane follows the pointer. @param {Camera} camera @param {Vec} pivot @param {number} x @param {number} y parts of the image @returns {Camera} */
export function panned(camera, pivot, x, y) {
  const [left, right, bottom, top] = camera.viewport;
  const t = isParallel(camera) ? 1 : dot(minus(camera.eye, pivot), normalized(camera.w)) / camera.distance / length(camera.w);
  const across = times(-x * (right - left) * t, camera.u), up = times(y * (top - bottom) * t, camera.v);
  return { ...camera, eye: plus(camera.eye, plus(across, up)) };
}

/** Move towards the pivot, to `factor` times as far; in parallel projection scale the viewport. @param {Camera} camera @param {Vec} pivot @param {number} factor @returns {Camera} */
export function zoomed(camera, pivot, factor) {
  if (isParallel(camera)) {
    const viewport = /** @type {Camera["viewport"]} */ (camera.viewport.map((edge) => edge * factor));
    return { ...camera, viewport };
  }
  return { ...camera, eye: plus(pivot, times(factor, minus(camera.eye, pivot))) };
}
