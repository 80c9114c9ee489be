// The camera: from pixels to rays, and back. The same camera as renderer/camera.py.
// Pixels are (i, j) = (row, column), from 0, row 0 at the top. Sizes are [width, height].

import { checkLens, lensOf } from "./lens.js";
import { cross, dot, inverseRows, length, minus, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {[number, number]} Size */
/**
 * The fields of a view file.
 * @typedef {object} Camera
 * @property {Vec} eye in world units
 * @property {Vec} u right
 * @property {Vec} v up
 * @property {Vec} w back
 * @property {number} distance from the eye to the viewport along -w, in units of w
 * @property {[number, number, number, number]} viewport left, right, bottom, top in units of u and v
 * @property {"perspective" | "parallel"} projection
 * @property {number} [near]
 * @property {number} [far]
 * @property {import("./lens.js").LensFields} [lens]
 * @property {boolean} [fit] whether the viewport follows the image's aspect ratio
 */
/** @typedef {{origin: Vec, direction: Vec}} Ray r(t) = origin + t direction, t > 0 */

const SINGULAR = 1e-9; // unit vectors that span less volume have no usable inverse
const SMALLEST = 1e-12, LARGEST = 1e12;

/** @param {Camera} camera */
export const isParallel = (camera) => camera.projection === "parallel";

/**
 * Return (x, y) on the image plane, in units of u and v, of the centre of pixel (i, j).
 * @param {Camera} camera @param {number} i @param {number} j @param {Size} size
 * @returns {[number, number]}
 */
export function imagePoint(camera, i, j, [width, height]) {
  const [left, right, bottom, top] = camera.viewport;
  return [left + ((j + 0.5) / width) * (right - left), top - ((i + 0.5) / height) * (top - bottom)];
}

/**
 * Return the point of the world at (x, y) on the image plane, in units of u and v. Parallel rays
 * begin on the plane through the eye.
 * @param {Camera} camera @param {number} x @param {number} y @returns {Vec}
 */
export function imagePlanePoint(camera, x, y) {
  const point = plus(camera.eye, plus(times(x, camera.u), times(y, camera.v)));
  return isParallel(camera) ? point : minus(point, times(camera.distance, camera.w));
}

/**
 * Return the viewing ray of pixel (i, j). The direction is not normalised; NaN outside of the lens.
 * @param {Camera} camera @param {number} i @param {number} j @param {Size} size @returns {Ray}
 */
export function viewingRay(camera, i, j, size) {
  const [x, y] = imagePoint(camera, i, j, size);
  const across = plus(times(x, camera.u), times(y, camera.v));
  if (isParallel(camera)) return { origin: plus(camera.eye, across), direction: times(-1, camera.w) };
  if (!camera.lens) return { origin: camera.eye, direction: minus(across, times(camera.distance, camera.w)) };
  return { origin: camera.eye, direction: lensDirection(camera, x, y) };
}

/**
 * Return the direction of the ray through a point of the image plane, behind a lens.
 * @param {Camera} camera @param {number} x @param {number} y @returns {Vec}
 */
function lensDirection({ u, v, w, distance, lens }, x, y) {
  const [a, b, c] = lensOf(/** @type {import("./lens.js").LensFields} */ (lens)).direction(x / distance, -y / distance);
  return plus(plus(times(a * distance, u), times(-b * distance, v)), times(-c * distance, w));
}

/**
 * Return where a point of the world is in the image: the inverse of viewingRay(). row and column
 * are NaN for a point that is not in front of the eye, or that the lens does not see.
 * @param {Camera} camera @param {Vec} point @param {Size} size
 */
export function project(camera, point, [width, height]) {
  const from = minus(point, camera.eye);
  const own = inverseRows(camera.u, camera.v, camera.w).map((row) => dot(row, from)), z = own[2];
  const { distance } = camera;
  let [x, y] = own;
  let parameter = -z;
  if (camera.lens) {
    const lens = lensOf(camera.lens), [a, b] = lens.imagePoint(x, -y, -z);
    parameter = lens.length(x, -y, -z) / distance;
    [x, y] = [a * distance, -b * distance];
  } else if (!isParallel(camera)) {
    parameter = -z / distance;
    [x, y] = parameter > 0 ? [x / parameter, y / parameter] : [NaN, NaN];
  }
  const [left, right, bottom, top] = camera.viewport;
  const column = ((x - left) / (right - left)) * width - 0.5;
  return { row: ((top - y) / (top - bottom)) * height - 0.5, column, parameter };
}

/** Return [t_min, t_max]: near and far as ray parameters. @param {Camera} camera @returns {[number, number]} */
export function parameterRange(camera) {
  const unit = isParallel(camera) ? 1 : camera.distance;
  return [(camera.near ?? 0) / unit, (camera.far ?? Infinity) / unit];
}

/**
 * Return the camera that draws an image of this size: its viewport enlarged about its centre, in one
 * direction, to the image's aspect ratio, if it says `fit`.
 * @param {Camera} camera @param {Size} size @returns {Camera}
 */
export function cameraForSize(camera, [width, height]) {
  if (!camera.fit) return camera;
  const [left, right, bottom, top] = camera.viewport;
  const x = (left + right) / 2, y = (bottom + top) / 2, aspect = width / height;
  const dx = Math.max((right - left) / 2, ((top - bottom) / 2) * aspect);
  const dy = Math.max((top - bottom) / 2, (right - left) / 2 / aspect);
  return { ...camera, viewport: [x - dx, x + dx, y - dy, y + dy] };
}

/**
 * Return a camera from a view file's fields: from all that a camera must have, or else from some
 * of them and the old camera's. Throws an Error with one line for one that cannot be.
 * @param {Partial<Camera>} given @param {Camera} old @returns {Camera}
 */
export function checkedCamera(given, old) {
  for (const name of Object.keys(given)) if (!(name in FIELDS)) throw new Error(`${name}: no field of a camera`);
  const isWhole = Object.keys(FIELDS).every((name) => name in given || OPTIONAL.includes(name));
  const camera = /** @type {any} */ (isWhole ? { ...given } : { ...old, ...given });
  for (const [name, count] of Object.entries(FIELDS)) {
    if (count && camera[name] !== undefined) camera[name] = checkedNumbers(name, camera[name], count);
  }
  for (const name of OPTIONAL) if (camera[name] == null) delete camera[name];
  const { u, v, w, viewport, near, far } = camera, [left, right, bottom, top] = viewport;
  if (!(Math.abs(dot(cross(u, v), w)) > SINGULAR * length(u) * length(v) * length(w)) || Math.min(length(u), length(v), length(w)) < SMALLEST) {
    throw new Error("u, v, w: must be independent of one another");
  }
  if (!(camera.distance >= SMALLEST)) throw new Error("distance: must be above 0");
  if (!(right > left && top > bottom)) throw new Error("viewport: needs left < right, bottom < top");
  if (!["perspective", "parallel"].includes(camera.projection)) throw new Error("projection: give perspective or parallel");
  if (camera.lens) checkLens(camera.lens);
  if (camera.lens && isParallel(camera)) throw new Error("lens: parallel rays cannot pass through a lens");
  if (near <= 0 || far <= (near ?? 0)) throw new Error("near, far: need 0 < near < far");
  return camera;
}

/** The number of numbers of each field; 0: other values. */
const FIELDS = { eye: 3, u: 3, v: 3, w: 3, distance: 1, viewport: 4, projection: 0, near: 1, far: 1, lens: 0, fit: 0 };

const OPTIONAL = ["near", "far", "lens", "fit"];

/** @param {string} name @param {any} value @param {number} count */
function checkedNumbers(name, value, count) {
  const numbers = count === 1 ? [value] : value;
  if (value === null) return value;
  if (!Array.isArray(numbers) || numbers.length !== count || !numbers.every((x) => typeof x === "number" && Math.abs(x) <= LARGEST)) {
    throw new Error(`${name}: give ${count === 1 ? "a number" : `${count} numbers`}`);
  }
  return count === 1 ? value : [...value];
}
