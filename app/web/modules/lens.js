// Lenses: where a camera without a projection matrix sees a direction, and back. The same models as
// renderer/camera/lenses.py: an ideal projection to a plane (a pinhole's, a fisheye's), then a distortion.
// Axes of computer vision: a to the right, b downwards, directions (X, Y, Z) with Z forwards.

import { Distortion } from "./distortion.js";

/** @typedef {{model: string, [coefficient: string]: number | string}} LensFields */
/** @typedef {[number, number]} Point */
/** @typedef {[number, number, number]} Direction */
/**
 * @typedef {object} Lens
 * @property {(a: number, b: number) => Direction} direction NaN outside of the lens
 * @property {(x: number, y: number, z: number) => Point} imagePoint NaN where nothing is seen
 * @property {(x: number, y: number, z: number) => number} length in units of direction()
 */

const NO_DIRECTION = /** @type {Direction} */ ([NaN, NaN, NaN]);

/** The coefficients of each model, as in renderer/lenses.py. @type {Record<string, string[]>} */
const LENS_MODELS = {
  brown: ["k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "s1", "s2", "s3", "s4", "r8"],
  fisheye: ["k1", "k2", "k3", "k4"],
  fov: ["omega"],
  thin_prism_fisheye: ["k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"],
  equidistant: [],
  stereographic: [],
  equisolid: [],
  orthographic: [],
  equirectangular: [],
  cylindrical: [],
};

/** Throw an Error for fields that are no lens's. @param {LensFields} fields */
export function checkLens({ model, ...coefficients }) {
  if (!Object.hasOwn(LENS_MODELS, model)) throw new Error(`lens: the model is one of ${Object.keys(LENS_MODELS).join(", ")}`);
  for (const [name, x] of Object.entries(coefficients)) {
    if (!LENS_MODELS[model].includes(name) || !Number.isFinite(x)) throw new Error(`lens: ${name} is no coefficient of ${model}`);
  }
  if (model === "fov" && !(Number(coefficients.omega) > 0 && Number(coefficients.omega) < Math.PI)) throw new Error("lens: omega is an angle between 0 and pi");
}

/** @type {WeakMap<LensFields, Lens>} */
const madeLenses = new WeakMap();

/** Return the maps of a lens, which are made once. @param {LensFields} fields @returns {Lens} */
export function lensOf(fields) {
  const lens = madeLenses.get(fields) ?? makeLens(fields);
  madeLenses.set(fields, lens);
  return lens;
}

/** @param {LensFields} fields @returns {Lens} */
function makeLens(fields) {
  /** @param {string} name */
  const coefficient = (name) => Number(fields[name] ?? 0);
  const omega = coefficient("omega");
  const distortion = distortionOf(fields.model, coefficient);
  return {
    direction(a, b) {
      if (distortion) [a, b] = distortion.inverse(a, b);
      return planeDirection(fields.model, omega, a, b);
    },
    imagePoint(x, y, z) {
      const [a, b] = planePoint(fields.model, omega, x, y, z);
      return distortion ? distortion.forward(a, b) : [a, b];
    },
    length(x, y, z) {
      if (fields.model === "brown") return z;
      return fields.model === "cylindrical" ? Math.hypot(x, z) : Math.hypot(x, y, z);
    },
  };
}

/** @param {string} model @param {(name: string) => number} coefficient */
function distortionOf(model, coefficient) {
  const [k1, k2, k3, k4, k5, k6, p1, p2, r8] = ["k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "r8"].map(coefficient);
  const prismNames = model === "brown" ? ["s1", "s2", "s3", "s4"] : ["sx1", "", "sy1", ""];
  const prism = prismNames.map(coefficient);
  if (model === "fov" || ![k1, k2, k3, k4, k5, k6, p1, p2, r8, ...prism].some((c) => c !== 0)) return null;
  return model === "brown"
    ? new Distortion([1, k1, k2, k3, r8], [1, k4, k5, k6], p1, p2, prism, Infinity)
    : new Distortion([1, k1, k2, k3, k4], [1], p1, p2, prism, Math.PI);
}

/** @param {string} model @param {number} omega @param {number} x @param {number} y @param {number} z @returns {Point} */
function planePoint(model, omega, x, y, z) {
  if (model === "equirectangular") return [Math.atan2(x, z), Math.atan2(y, Math.hypot(x, z))];
  if (model === "cylindrical") return [Math.atan2(x, z), y / Math.hypot(x, z)];
  if (model === "brown") return z > 0 ? [x / z, y / z] : [NaN, NaN];
  const across = Math.hypot(x, y);
  if (across === 0) return z > 0 ? [0, 0] : [NaN, NaN];
  const scale = radiusOf(model, omega, Math.atan2(across, z)) / across;
  return [x * scale, y * scale];
}

/** @param {string} model @param {number} omega @param {number} a @param {number} b @returns {Direction} */
function planeDirection(model, omega, a, b) {
  if (model === "brown") return Number.isNaN(a) ? NO_DIRECTION : [a, b, 1];
  if (model === "equirectangular") {
    if (!(Math.abs(a) <= Math.PI && Math.abs(b) <= Math.PI / 2)) return NO_DIRECTION;
    return [Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)];
  }
  if (model === "cylindrical") return Math.abs(a) <= Math.PI ? [Math.sin(a), b, Math.cos(a)] : NO_DIRECTION;
  const radius = Math.hypot(a, b);
  const angle = angleOf(model, omega, radius);
  if (Number.isNaN(angle)) return NO_DIRECTION;
  const scale = radius > 0 ? Math.sin(angle) / radius : 1;
  return [a * scale, b * scale, Math.cos(angle)];
}

/** Return how far from the image's middle an angle to the axis is. @param {string} model @param {number} omega @param {number} angle */
function radiusOf(model, omega, angle) {
  switch (model) {
    case "stereographic":
      return angle < Math.PI ? 2 * Math.tan(angle / 2) : NaN;
    case "equisolid":
      return 2 * Math.sin(angle / 2);
    case "orthographic":
      return angle <= Math.PI / 2 ? Math.sin(angle) : NaN;
    case "fov":
      return angle < Math.PI / 2 ? Math.atan(2 * Math.tan(angle) * Math.tan(omega / 2)) / omega : NaN;
    default: // equidistant, which fisheyes distort
      return angle;
  }
}

/** Return the angle to the axis of a distance from the image's middle. @param {string} model @param {number} omega @param {number} radius */
function angleOf(model, omega, radius) {
  switch (model) {
    case "stereographic":
      return 2 * Math.atan(radius / 2);
    case "equisolid":
      return 2 * Math.asin(radius / 2);
    case "orthographic":
      return Math.asin(radius);
    case "fov":
      return radius * omega < Math.PI / 2 ? Math.atan(Math.tan(radius * omega) / (2 * Math.tan(omega / 2))) : NaN;
    default:
      return radius <= Math.PI ? radius : NaN;
  }
}
