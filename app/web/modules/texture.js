// Textures: where of its image a hit is, and the light between the middles of four texels there.
// The same lookup as renderer/trace/reference/texture.py and shaders/chunks/texture.glsl.

import { CLAMP, MIRROR, TEXEL_BITS, WRAP_BITS } from "./numbers.js";
import { between, cross, dot } from "./vectors.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./vectors.js").Vec} Vec */

const MOST = (1 << TEXEL_BITS) - 1;

/**
 * Return the texel coordinates of a triangle's point.
 * @param {Scene} scene @param {number} triangle @param {number} b1 @param {number} b2
 * @returns {[number, number]}
 */
export function placeOnTriangle({ uv, faces }, triangle, b1, b2) {
  const p = 2 * faces[3 * triangle], q = 2 * faces[3 * triangle + 1], r = 2 * faces[3 * triangle + 2];
  if (!uv.length) return [0, 0];
  const b0 = 1 - b1 - b2;
  return [b0 * uv[p] + b1 * uv[q] + b2 * uv[r], b0 * uv[p + 1] + b1 * uv[q + 1] + b2 * uv[r + 1]];
}

/**
 * Return those of a direction from a sphere's centre: longitude and latitude.
 * @param {Scene} scene @param {number} object @param {Vec} n @returns {[number, number]}
 */
export function placeOnSphere({ materials }, object, [x, y, z]) {
  const u = 0.5 + Math.atan2(x, z) / (2 * Math.PI);
  const v = 0.5 + Math.atan2(y, Math.sqrt(x * x + z * z)) / Math.PI;
  const m = 12 * object + 8;
  return [materials[m] * u + materials[m + 1], materials[m + 2] * v + materials[m + 3]];
}

/**
 * Return the linear light of one of an object's images.
 * @param {Scene} scene @param {number} object @param {number} first its first texel
 * @param {[number, number]} place @returns {Vec}
 */
export function lightAtPlace({ texels, textures }, object, first, place) {
  const { upper, lower, right, down } = fourTexels(textures, object, first, place);
  /** @param {number} at */
  const light = (at) => lightOfTexel(texels[at]);
  const above = between(right, light(upper[0]), light(upper[1]));
  return between(down, above, between(right, light(lower[0]), light(lower[1])));
}

/** @param {number} texel @returns {Vec} */
function lightOfTexel(texel) {
  const red = texel & MOST, green = (texel >> TEXEL_BITS) & MOST, blue = texel >> (2 * TEXEL_BITS);
  return [(red / MOST) ** 2, (green / MOST) ** 2, (blue / MOST) ** 2];
}

/** @param {Int32Array} textures @param {number} object @param {number} first @param {[number, number]} place */
function fourTexels(textures, object, first, [x, y]) {
  const width = textures[8 * object + 1], height = textures[8 * object + 2], wraps = textures[8 * object + 3];
  const wrapU = wraps & ((1 << WRAP_BITS) - 1), wrapV = wraps >> WRAP_BITS;
  const column = Math.floor(x - 0.5), row = Math.floor(y - 0.5);
  const left = wrapped(column, width, wrapU), next = wrapped(column + 1, width, wrapU);
  const upper = first + (width + 1) * wrapped(row, height, wrapV);
  const lower = first + (width + 1) * wrapped(row + 1, height, wrapV);
  return {
    upper: [upper + left, upper + next],
    lower: [lower + left, lower + next],
    right: x - 0.5 - column,
    down: y - 0.5 - row,
  };
}

/** Return the number of a texel that may lie beyond an image of `size` texels. @param {number} i @param {number} size @param {number} wrap */
function wrapped(i, size, wrap) {
  if (wrap === CLAMP) return Math.min(Math.max(i, 0), size - 1);
  const period = wrap === MIRROR ? 2 * size : size;
  const inside = i - period * Math.floor(i / period);
  return inside >= size ? period - 1 - inside : inside;
}

/**
 * Return whether a ray passes a triangle that it meets: by its back, where that is not seen, or
 * through a hole.
 * @param {Scene} scene @param {Vec} direction @param {number} triangle @param {number} b1 @param {number} b2
 */
export function passes(scene, direction, triangle, b1, b2) {
  const object = scene.faceObject[triangle];
  if (scene.singleSided[object]) {
    const [x, y, z] = rowsOfObject(scene, object);
    const [toB, toC] = edgesOfTriangle(scene, triangle);
    if (dot(cross(x, y), z) * dot(cross(toB, toC), direction) > 0) return true;
  }
  const opacity = scene.textures[8 * object + 5];
  if (opacity < 0) return false;
  const place = placeOnTriangle(scene, triangle, b1, b2);
  const { upper, lower, right, down } = fourTexels(scene.textures, object, opacity, place), { texels } = scene;
  const above = (1 - right) * texels[upper[0]] + right * texels[upper[1]];
  const below = (1 - right) * texels[lower[0]] + right * texels[lower[1]];
  return (1 - down) * above + down * below < 0;
}

/** Return the rows of an object's turn into the world. @param {Scene} scene @param {number} object @returns {[Vec, Vec, Vec]} */
export function rowsOfObject({ worldFromObject: m }, object) {
  const at = 16 * object;
  return [
    [m[at], m[at + 1], m[at + 2]],
    [m[at + 4], m[at + 5], m[at + 6]],
    [m[at + 8], m[at + 9], m[at + 10]],
  ];
}

/** Return the edges a to b and a to c of a triangle, in the world. @param {Scene} scene @param {number} triangle @returns {[Vec, Vec]} */
export function edgesOfTriangle(scene, triangle) {
  const [x, y, z] = rowsOfObject(scene, scene.faceObject[triangle]), { vertices: v, faces } = scene;
  const a = 3 * faces[3 * triangle], b = 3 * faces[3 * triangle + 1], c = 3 * faces[3 * triangle + 2];
  const toB = /** @type {Vec} */ ([v[b] - v[a], v[b + 1] - v[a + 1], v[b + 2] - v[a + 2]]);
  const toC = /** @type {Vec} */ ([v[c] - v[a], v[c + 1] - v[a + 1], v[c + 2] - v[a + 2]]);
  return [[dot(x, toB), dot(y, toB), dot(z, toB)], [dot(x, toC), dot(y, toC), dot(z, toC)]];
}
