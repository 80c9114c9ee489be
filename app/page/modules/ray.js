// Image order: for each pixel, generate the viewing ray, find the closest object, determine the
// colour. A page runs this in a Web Worker: coarse first, full after.

import { cameraForSize, parameterRange, viewingRay } from "./camera.js";
import { buildTree, closestHit } from "./hierarchy.js";
import { AWAY, byteOfLight } from "./numbers.js";
import { colorAt, surfaceAt } from "./shade.js";
import { dot, eachTimes, minus, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./hierarchy.js").Tree} Tree */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {{shadows: boolean, mirrors: number, exposure: number}} Effects exposure: in stops */
/**
 * @typedef {object} ImageRequest
 * @property {number} number
 * @property {Camera} camera
 * @property {Size} size
 * @property {Effects} effects
 * @property {boolean} whole answer with the full image alone
 */
/** @typedef {{number: number, factor: number, width: number, height: number, bytes: Uint8ClampedArray}} ImagePart factor: pixels a side that one colour stands for */

const FIRST_IMAGE_MS = 30; // how long a coarse image may take
const SLICE_MS = 15; // how long the worker computes before it looks for a newer request
const COARSEST = 16;

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
 * @param {Uint8ClampedArray} bytes of the coarse image, written
 */
export function traceRow(tree, { camera, size, effects }, factor, row, bytes) {
  const [width, height] = size, columns = Math.ceil(width / factor), gain = 2 ** effects.exposure;
  const fitted = cameraForSize(camera, size), range = parameterRange(fitted);
  const i = Math.min(row * factor + (factor >> 1), height - 1);
  for (let column = 0; column < columns; column += 1) {
    const j = Math.min(column * factor + (factor >> 1), width - 1);
    const { origin, direction } = viewingRay(fitted, i, j, size);
    const light = lightAlong(tree, origin, direction, range, effects);
    const at = 4 * (row * columns + column);
    for (let k = 0; k < 3; k += 1) bytes[at + k] = byteOfLight(light[k], gain);
    bytes[at + 3] = 255;
  }
}

/**
 * Return what a pixel's ray hits.
 * @param {Tree} tree @param {ImageRequest & {pixel: [number, number]}} request
 */
function probed(tree, { camera, size, effects, pixel }) {
  const fitted = cameraForSize(camera, size), range = parameterRange(fitted);
  const { origin, direction } = viewingRay(fitted, ...pixel, size), hit = closestHit(tree, origin, direction, ...range);
  const color = lightAlong(tree, origin, direction, range, effects).map((light) => byteOfLight(light, 2 ** effects.exposure));
  if (hit.primitive < 0) return { t: Infinity, object: -1, point: origin, normal: direction, color };
  const { object, point, normal } = surfaceAt(tree.scene, origin, direction, hit);
  return { t: hit.t, object, point, normal, color };
}

/**
 * Answer a page's messages, in a worker: {scene}, then ImageRequests, or some with a pixel. The newest one that is not
 * `whole` wins; those that are whole are all answered.
 * @param {{postMessage: (message: any, transfer?: Transferable[]) => void, onmessage: any}} port
 */
export function serveImages(port) {
  /** @type {Tree | null} */
  let tree = null;
  /** @type {ImageRequest | null} */
  let newest = null;
  /** @type {ImageRequest[]} */
  const whole = [];
  let isBusy = false, pixelsPerMs = 50;
  // A task of its own, after the messages that wait. Timers are slower: they wait 4 ms.
  const channel = new MessageChannel();
  const nextTask = () => new Promise((resolve) => {
    channel.port1.onmessage = resolve;
    channel.port2.postMessage(null);
  });

  /** @param {ImageRequest} request @param {number} factor @returns {Promise<boolean>} whether it was finished */
  async function trace(request, factor) {
    const width = Math.ceil(request.size[0] / factor), height = Math.ceil(request.size[1] / factor);
    const bytes = new Uint8ClampedArray(4 * width * height), start = performance.now();
    let since = start, waited = 0;
    for (let row = 0; row < height; row += 1) {
      traceRow(/** @type {Tree} */ (tree), request, factor, row, bytes);
      if (performance.now() - since < SLICE_MS) continue;
      const before = performance.now();
      await nextTask();
      since = performance.now();
      waited += since - before;
      if (!request.whole && newest !== request) return false;
    }
    pixelsPerMs = (width * height) / Math.max(performance.now() - start - waited, 0.1);
    port.postMessage({ number: request.number, factor, width, height, bytes }, [bytes.buffer]);
    return true;
  }

  async function work() {
    if (isBusy || !tree) return;
    isBusy = true;
    for (let request = whole.shift() ?? newest; request; request = whole.shift() ?? newest) {
      const [width, height] = request.size;
      let factor = 1;
      while (!request.whole && factor < COARSEST && (width * height) / factor ** 2 > pixelsPerMs * FIRST_IMAGE_MS) factor *= 2;
      while ((await trace(request, factor)) && factor > 1) {
        await nextTask();
        if (newest !== request) break;
        factor = factor > 4 ? factor / 4 : 1;
      }
      if (newest === request) newest = null;
    }
    isBusy = false;
  }

  port.onmessage = (/** @type {MessageEvent} */ { data }) => {
    if (data.scene) tree = buildTree(data.scene);
    else if (data.pixel) port.postMessage({ number: data.number, ...probed(/** @type {Tree} */ (tree), data) });
    else if (data.whole) whole.push(data);
    else newest = data;
    work();
  };
}

// The page's own text is the worker's too: there, no document is.
if (typeof document === "undefined" && typeof postMessage === "function") serveImages(/** @type {any} */ (globalThis));
