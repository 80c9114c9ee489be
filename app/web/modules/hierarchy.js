// The bounding volume hierarchy: a tree of boxes, so that a ray meets few of the scene's triangles.
// The same mathematics as renderer/trace/reference/: boxes by slabs, triangles watertight in float64.

import { closestSphere } from "./sphere.js";
import { passes } from "./texture.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./vectors.js").Vec} Vec */
/**
 * @typedef {object} Tree
 * @property {Scene} scene
 * @property {Vec} middle the point of the world that boxes and shapes are relative to
 * @property {Float64Array} boxes 6 for each node, low x, y, z, high x, y, z; node 0 is the root
 * @property {Int32Array} links 2 for each node: first child and 0, or first shape and their number
 * @property {Int32Array} order the primitive of each shape
 * @property {Float64Array} shapes 9 each: a triangle's corners, or a sphere's centre and radius
 */
/** @typedef {{t: number, primitive: number, b1: number, b2: number}} RayHit primitive is -1 for none */

const LEAF_SIZE = 4;
const BINS = 12;
const SLACK = 1e-12; // of boxes, relative: more than roundings of float64 add up to
const HUGE = 1e290; // stands for 1 / 0: finite, because 0 * Infinity is NaN

/** Return the tree of a scene's triangles and spheres. @param {Scene} scene @returns {Tree} */
export function buildTree(scene) {
  const triangles = scene.faceObject.length, count = triangles + scene.sphereObject.length;
  const { bounds } = scene;
  const middle = /** @type {Vec} */ ([0, 1, 2].map((k) => (bounds[k] + bounds[3 + k]) / 2));
  const shapes = new Float64Array(9 * count);
  for (let n = 0; n < count; n += 1) placeShape(scene, middle, n, shapes);
  const boxes = new Float64Array(6 * count);
  for (let n = 0; n < count; n += 1) boxOfShape(shapes, n, n >= triangles, boxes);
  const order = Int32Array.from({ length: count }, (_, n) => n);
  const nodes = { boxes: new Float64Array(12 * count), links: new Int32Array(4 * count), used: 1 };
  if (count) split(nodes, boxes, order, 0, 0, count, 0);
  const inOrder = new Float64Array(9 * count);
  order.forEach((number, k) => inOrder.set(shapes.subarray(9 * number, 9 * number + 9), 9 * k));
  return { scene, middle, boxes: nodes.boxes, links: nodes.links, order, shapes: inOrder };
}

/** @param {Scene} scene @param {Vec} middle @param {number} n @param {Float64Array} shapes */
function placeShape(scene, middle, n, shapes) {
  const triangles = scene.faceObject.length;
  if (n >= triangles) {
    for (let k = 0; k < 4; k += 1) shapes[9 * n + k] = scene.spheres[4 * (n - triangles) + k] - (k < 3 ? middle[k] : 0);
    return;
  }
  const m = 16 * scene.faceObject[n], matrix = scene.worldFromObject, { vertices } = scene;
  for (let corner = 0; corner < 3; corner += 1) {
    const at = 3 * scene.faces[3 * n + corner];
    const x = vertices[at], y = vertices[at + 1], z = vertices[at + 2];
    for (let k = 0; k < 3; k += 1) {
      const row = m + 4 * k;
      shapes[9 * n + 3 * corner + k] =
        x * matrix[row] + y * matrix[row + 1] + z * matrix[row + 2] + (matrix[row + 3] - middle[k]);
    }
  }
}

/** @param {Float64Array} shapes @param {number} n @param {boolean} isSphere @param {Float64Array} boxes */
function boxOfShape(shapes, n, isSphere, boxes) {
  for (let k = 0; k < 3; k += 1) {
    const a = shapes[9 * n + k], b = shapes[9 * n + 3 + k], c = shapes[9 * n + 6 + k];
    const radius = shapes[9 * n + 3];
    boxes[6 * n + k] = isSphere ? a - radius : Math.min(a, b, c);
    boxes[6 * n + 3 + k] = isSphere ? a + radius : Math.max(a, b, c);
  }
}

/**
 * Make a node of the shapes order[first..last - 1], and the nodes below it, by the surface area
 * heuristic over BINS. Source: Wald, On fast construction of SAH-based bounding volume hierarchies.
 * @param {{boxes: Float64Array, links: Int32Array, used: number}} nodes @param {Float64Array} boxes
 * @param {Int32Array} order @param {number} node @param {number} first @param {number} last @param {number} depth
 */
function split(nodes, boxes, order, node, first, last, depth) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const least = [...low], most = [...high]; // of the boxes' centres, twice
  for (let n = first; n < last; n += 1) {
    for (let k = 0; k < 3; k += 1) {
      const a = boxes[6 * order[n] + k], b = boxes[6 * order[n] + 3 + k];
      low[k] = Math.min(low[k], a);
      high[k] = Math.max(high[k], b);
      least[k] = Math.min(least[k], a + b);
      most[k] = Math.max(most[k], a + b);
    }
  }
  for (let k = 0; k < 3; k += 1) {
    const slack = SLACK * (Math.abs(low[k]) + Math.abs(high[k]) + high[k] - low[k]);
    nodes.boxes[6 * node + k] = low[k] - slack;
    nodes.boxes[6 * node + 3 + k] = high[k] + slack;
  }
  if (last - first <= LEAF_SIZE || depth > 60) {
    nodes.links.set([first, last - first], 2 * node);
    return;
  }
  const spans = most.map((m, k) => m - least[k]), axis = spans.indexOf(Math.max(...spans));
  let middle = partition(boxes, order, first, last, axis, least[axis], spans[axis]);
  if (middle === first || middle === last) middle = (first + last) >> 1;
  const child = nodes.used;
  nodes.used += 2;
  nodes.links.set([child, 0], 2 * node);
  split(nodes, boxes, order, child, first, middle, depth + 1);
  split(nodes, boxes, order, child + 1, middle, last, depth + 1);
}

/**
 * Sort shapes to both sides of the best of BINS planes; return the first one of the second side.
 * @param {Float64Array} boxes @param {Int32Array} order @param {number} first @param {number} last
 * @param {number} axis @param {number} least @param {number} span
 */
function partition(boxes, order, first, last, axis, least, span) {
  /** @param {number} number */
  const binOf = (number) =>
    Math.min(BINS - 1, Math.floor((BINS * (boxes[6 * number + axis] + boxes[6 * number + 3 + axis] - least)) / span));
  if (!(span > 0)) return first;
  const bins = Array.from({ length: BINS }, () => [0, Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
  for (let n = first; n < last; n += 1) grow(bins[binOf(order[n])], 1, boxes, 6 * order[n]);
  const below = sweptCosts(bins), above = sweptCosts([...bins].reverse());
  let chosen = 1;
  for (let plane = 2; plane < BINS; plane += 1) {
    if (below[plane - 1] + above[BINS - plane - 1] < below[chosen - 1] + above[BINS - chosen - 1]) chosen = plane;
  }
  let left = first, right = last - 1;
  while (left <= right) {
    if (binOf(order[left]) < chosen) left += 1;
    else [order[left], order[right], right] = [order[right], order[left], right - 1];
  }
  return left;
}

/** @param {number[]} bin @param {number} count @param {ArrayLike<number>} box @param {number} at */
function grow(bin, count, box, at) {
  bin[0] += count;
  for (let k = 0; k < 3; k += 1) {
    bin[1 + k] = Math.min(bin[1 + k], box[at + k]);
    bin[4 + k] = Math.max(bin[4 + k], box[at + 3 + k]);
  }
}

/** Return the number of shapes in the first bins, times the area around them, for 1, 2, ... bins. @param {number[][]} bins */
function sweptCosts(bins) {
  const all = [0, Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  return bins.map((bin) => {
    if (bin[0]) grow(all, bin[0], bin, 1);
    const x = all[4] - all[1], y = all[5] - all[2], z = all[6] - all[3];
    return all[0] ? all[0] * (x * y + y * z + z * x) : 0;
  });
}

const waiting = new Int32Array(128), entered = new Float64Array(128);

/**
 * Return the closest hit with tMin < t < tMax. Of hits at the same t, the lowest primitive wins.
 * isAny: return the first hit that is found.
 * @param {Tree} tree @param {Vec} origin @param {Vec} direction @param {number} tMin
 * @param {number} tMax @param {boolean} [isAny] @returns {RayHit}
 */
export function closestHit(tree, origin, direction, tMin, tMax, isAny = false) {
  const { boxes, links, order, shapes, scene, middle } = tree, triangles = scene.faceObject.length;
  const hit = { t: Infinity, primitive: -1, b1: 0, b2: 0 };
  if (!order.length || Number.isNaN(direction[0])) return hit;
  const ox = origin[0] - middle[0], oy = origin[1] - middle[1], oz = origin[2] - middle[2];
  const ix = inverse(direction[0]), iy = inverse(direction[1]), iz = inverse(direction[2]);
  // Triangles are sheared so that the ray is the z axis: it goes farthest along the z chosen here.
  const ax = Math.abs(direction[0]), ay = Math.abs(direction[1]), az = Math.abs(direction[2]);
  const z = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2, x = (z + 1) % 3, y = (z + 2) % 3;
  const from = [ox, oy, oz], px = from[x], py = from[y], pz = from[z];
  const sx = direction[x] / direction[z], sy = direction[y] / direction[z], sz = 1 / direction[z];
  const local = /** @type {Vec} */ (from);
  let closest = tMax, top = 0, node = 0;
  /** Return where the ray enters a box, Infinity if it does not. @param {number} n */
  const enter = (n) => {
    const x1 = (boxes[n] - ox) * ix, x2 = (boxes[n + 3] - ox) * ix;
    const y1 = (boxes[n + 1] - oy) * iy, y2 = (boxes[n + 4] - oy) * iy;
    const z1 = (boxes[n + 2] - oz) * iz, z2 = (boxes[n + 5] - oz) * iz;
    const near = Math.max(Math.min(x1, x2), Math.min(y1, y2), Math.min(z1, z2), tMin);
    const far = Math.min(Math.max(x1, x2), Math.max(y1, y2), Math.max(z1, z2), closest);
    return near <= far * (1 + SLACK) + SLACK ? near : Infinity;
  };
  for (;;) {
    const first = links[2 * node], count = links[2 * node + 1];
    if (count === 0) {
      let near = first, far = first + 1, tNear = enter(6 * near), tFar = enter(6 * far);
      if (tFar < tNear) [near, far, tNear, tFar] = [far, near, tFar, tNear];
      if (tNear < Infinity) {
        if (tFar < Infinity) {
          waiting[top] = far;
          entered[top] = tFar;
          top += 1;
        }
        node = near;
        continue;
      }
    }
    for (let k = first; k < first + count; k += 1) {
      const number = order[k], s = 9 * k;
      let t, b1 = 0, b2 = 0;
      if (number >= triangles) t = closestSphere(shapes, s, local, direction, tMin, tMax);
      else {
        const za = shapes[s + z] - pz, zb = shapes[s + 3 + z] - pz, zc = shapes[s + 6 + z] - pz;
        const xa = shapes[s + x] - px - sx * za, ya = shapes[s + y] - py - sy * za;
        const xb = shapes[s + 3 + x] - px - sx * zb, yb = shapes[s + 3 + y] - py - sy * zb;
        const xc = shapes[s + 6 + x] - px - sx * zc, yc = shapes[s + 6 + y] - py - sy * zc;
        // The three edge functions are of one sign inside.
        const e0 = xc * yb - yc * xb, e1 = xa * yc - ya * xc, e2 = xb * ya - yb * xa, area = e0 + e1 + e2;
        if ((e0 < 0 || e1 < 0 || e2 < 0) && (e0 > 0 || e1 > 0 || e2 > 0)) continue;
        if (area === 0) continue; // seen edge-on
        t = ((e0 * za + e1 * zb + e2 * zc) * sz) / area;
        b1 = e1 / area;
        b2 = e2 / area;
      }
      if (!(tMin < t && (t < closest || (t === closest && number < hit.primitive)))) continue;
      if (number < triangles && passes(scene, direction, number, b1, b2)) continue;
      closest = t;
      hit.t = t;
      hit.primitive = number;
      hit.b1 = b1;
      hit.b2 = b2;
      if (isAny) return hit;
    }
    do {
      if (top === 0) return hit;
      top -= 1;
    } while (entered[top] > closest);
    node = waiting[top];
  }
}

/** @param {number} x */
const inverse = (x) => (Math.abs(x) > 1 / HUGE ? 1 / x : x < 0 || Object.is(x, -0) ? -HUGE : HUGE);
