// The exercise that is answered in the scene: one object is put where it hides another one. The
// same as app/lecture/hiding.py; pixels are counted along the viewing rays of the ray image.

import { cameraForSize, parameterRange, viewingRay } from "./camera.js";
import { buildTree, closestHit } from "./hierarchy.js";
import { objectOf } from "./scene.js";
import { dot, minus } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {[number, number]} Range the first of its objects, and the one after the last */
/**
 * @typedef {object} Hiding
 * @property {Range} moved @property {Range} hidden @property {string} name of the hidden one, escaped
 * @property {Vec} behind the middle of the hidden one @property {number} alone pixels that show the hidden one without the other
 * @property {number} atMost @property {Size} size @property {Camera} camera
 */

/** Return a scene whose objects can be moved without changing the given one. @param {Scene} scene @returns {Scene} */
export const movable = (scene) => ({
  ...scene,
  ...Object.fromEntries((/** @type {const} */ (["worldFromObject", "spheres", "bounds"])).map((name) => [name, scene[name].slice()])),
});

/** Move objects of a scene. @param {Scene} scene changed @param {Range} objects @param {Vec} by */
export function shiftObjects({ worldFromObject, spheres, sphereObject, bounds }, [first, last], by) {
  by.forEach((step, k) => {
    for (let object = first; object < last; object += 1) worldFromObject[16 * object + 4 * k + 3] += step;
    sphereObject.forEach((object, n) => {
      if (object >= first && object < last) spheres[4 * n + k] += step;
    });
    bounds[k] += Math.min(step, 0);
    bounds[3 + k] += Math.max(step, 0);
  });
}

/** Count an image's pixels that show objects of each range. @param {Scene} scene @param {Hiding} hiding @param {Range[]} ranges */
function pixelsOf(scene, { camera, size }, ranges) {
  const tree = buildTree(scene), fitted = cameraForSize(camera, size), range = parameterRange(fitted);
  const counts = ranges.map(() => 0);
  for (let i = 0; i < size[1]; i += 1)
    for (let j = 0; j < size[0]; j += 1) {
      const { origin, direction } = viewingRay(fitted, i, j, size), { primitive } = closestHit(tree, origin, direction, ...range);
      const object = primitive < 0 ? -1 : objectOf(scene, primitive);
      ranges.forEach(([first, last], k) => (counts[k] += object >= first && object < last ? 1 : 0));
    }
  return counts;
}

/**
 * Return whether the object hides the other one, and what is said.
 * @param {Hiding} hiding @param {Record<string, string>} texts @param {Scene} scene @param {Vec} place of the object's middle
 */
export function checkPlace(hiding, texts, scene, place) {
  const { alone, size, atMost, name, behind, camera } = hiding;
  if (!alone) return { right: false, text: texts.nowhere };
  const [moved, seen] = pixelsOf(scene, hiding, [hiding.moved, hiding.hidden]), part = seen / alone;
  if (moved === 0 || moved === size[0] * size[1]) return { right: false, text: moved ? texts.fills : texts.gone };
  if (part <= atMost) return { right: true, text: seen ? texts.right : texts.none };
  const text = `${percent(part)} of the ${name} can still be seen.`, isBehind = dot(minus(place, behind), camera.w) < 0;
  return { right: false, text: isBehind ? `${text} ${texts.behind}` : text };
}

/** Return a part as a percentage; small ones have one decimal more. @param {number} part */
function percent(part) {
  const scale = part >= 0.0995 ? 1 : 10, x = 100 * part * scale, floor = Math.floor(x);
  const whole = x - floor === 0.5 ? floor + (floor % 2) : Math.round(x); // halves to even, as Python rounds
  return `${scale === 1 ? whole : (whole / 10).toFixed(1)} %`;
}
