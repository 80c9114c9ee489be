// Image order: for each pixel, generate the viewing ray, find the closest object, determine the
// colour. Web Workers run this: ray_worker.js.

import { cameraForSize, parameterRange, viewingRay } from "./camera.js";
import { closestHit } from "./hierarchy.js";
import { AWAY, byteOfLight } from "./numbers.js";
import { colorAt, surfaceAt } from "./shade.js";
import { dot, eachTimes, minus, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./hierarchy.js").Tree} Tree */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {{shadows: boolean, mirrors: number, exposure: number}} Effects exposure: in stops */
/** @typedef {{camera: Camera, size: Size, effects: Effects}} ImageRequest */

/**
 * Return the light along a ray: linear red, green, blue.
 * @param {Tree} tree @param {Vec} origin @param {Vec} direction @param {[number, number]} range
 * @param {Effects} effects @param {number} [bounces] reflections so far @returns {Vec}
 */
export function lightAlong(tree, origin, direction, range, effects, bounces = 0) {
  const { scene } = tree;
  const hit = closestHit(tree, origin, direction, ...range);
  if (hit.primitive < 0) return [scene.background[0], scene.background[1], scene.background[2]];
  const surface = surfaceAt(scene, origin, direction, hit);
  const start = plus(surface.point, times(awayFrom(scene), surface.geometric));
  const light = colorAt(scene, surface, direction, (toLight, distance) => {
    if (!effects.shadows) return true;
    if (dot(surface.geometric, toLight) <= 0) return false;
    const reach = distance === Infinity ? distance : distance - dot(minus(start, surface.point), toLight);
    return closestHit(tree, start, toLight, 0, reach, true).primitive < 0;
  });
  if (bounces >= effects.mirrors || !surface.specular.some((part) => part > 0)) return light;
  const { geometric, normal } = surface;
  let way = minus(direction, times(2 * dot(direction, normal), normal));
  // A smooth normal may send a ray into the surface.
  if (dot(way, geometric) <= 0) way = minus(direction, times(2 * dot(direction, geometric), geometric));
  return plus(light, eachTimes(surface.specular, lightAlong(tree, start, way, [0, Infinity], effects, bounces + 1)));
}

/** Return how far from a surface shadow and mirror rays start. @param {Scene} scene */
function awayFrom({ bounds }) {
  return (AWAY * Math.max(bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2])) / 2;
}

/**
 * Trace a row of an image, of which every factor-th pixel in both directions is wanted: the middle
 * one of each square.
 * @param {Tree} tree @param {ImageRequest} request @param {number} factor @param {number} row
 * @param {Uint8ClampedArray} bytes of this row, written
 */
export function traceRow(tree, { camera, size, effects }, factor, row, bytes) {
  const [width, height] = size, gain = 2 ** effects.exposure;
  const fitted = cameraForSize(camera, size), range = parameterRange(fitted);
  const i = Math.min(row * factor + (factor >> 1), height - 1);
  for (let at = 0; at < bytes.length; at += 4) {
    const j = Math.min((at / 4) * factor + (factor >> 1), width - 1);
    const { origin, direction } = viewingRay(fitted, i, j, size);
    const light = lightAlong(tree, origin, direction, range, effects);
    for (let k = 0; k < 3; k += 1) bytes[at + k] = byteOfLight(light[k], gain);
    bytes[at + 3] = 255;
  }
}

/**
 * Return what a pixel's ray hits.
 * @param {Tree} tree @param {ImageRequest} request @param {[number, number]} pixel
 */
export function probed(tree, { camera, size, effects }, pixel) {
  const fitted = cameraForSize(camera, size), range = parameterRange(fitted);
  const { origin, direction } = viewingRay(fitted, ...pixel, size), hit = closestHit(tree, origin, direction, ...range);
  const color = lightAlong(tree, origin, direction, range, effects).map((light) => byteOfLight(light, 2 ** effects.exposure));
  if (hit.primitive < 0) return { t: Infinity, object: -1, point: origin, normal: direction, color };
  const { object, point, normal } = surfaceAt(tree.scene, origin, direction, hit);
  return { t: hit.t, object, point, normal, color };
}
