// Triangle setup: the shaders' input for one camera, computed in float64. The same numbers as
// renderer/raster/setup.py, which says why they are what they are.

import { isParallel, parameterRange } from "./camera.js";
import { objectCount } from "./scene.js";
import { cross, dot, inverseRows, length, minus, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {{camera: Camera, size: Size, unit?: Vec}} RasterView a pinhole; unit: of a lens's face, see lens_faces.py */

export const OBJECT_TEXELS = 15, SPHERE_TEXELS = 3;
const NEAREST_CLIP = 1e-6, TINY = 1e-30, FLOAT32_MAX = 3.4028234663852886e38;
const MARGIN = 1024;

/** Return by how many pixels the viewport extends beyond the image on each side. @param {number} side */
export const marginOf = (side) => Math.min(Math.max((side >> 1) + 1, MARGIN), Math.max(0, (8192 - side) >> 1));

/** Return an object's turn by its rows, its place and the middle of its box. @param {Scene} scene @param {number} object */
export function placeOfObject({ worldFromObject, objectBounds }, object) {
  /** @param {number} row @returns {Vec} */
  const rowAt = (row) => /** @type {Vec} */ ([0, 1, 2].map((k) => worldFromObject[16 * object + 4 * row + k]));
  const rows = /** @type {[Vec, Vec, Vec]} */ ([rowAt(0), rowAt(1), rowAt(2)]);
  const place = /** @type {Vec} */ ([3, 7, 11].map((k) => worldFromObject[16 * object + k]));
  const low = /** @type {Vec} */ (Array.from(objectBounds.subarray(6 * object, 6 * object + 3)));
  const high = /** @type {Vec} */ (Array.from(objectBounds.subarray(6 * object + 3, 6 * object + 6)));
  return { rows, place, low, high, middle: times(0.5, plus(low, high)) };
}

/** Return the product of a matrix, by its rows, and a vector. @param {Vec[]} rows @param {Vec} a @returns {Vec} */
const applied = (rows, a) => /** @type {Vec} */ (rows.map((row) => dot(row, a)));

/** @param {Vec[]} rows @returns {[Vec, Vec, Vec]} */
const transposed = (rows) => /** @type {any} */ ([0, 1, 2].map((k) => rows.map((row) => row[k])));

/** Return the columns of a matrix's inverse, by its rows. @param {Vec[]} rows */
const inverted = (rows) => inverseRows(...transposed(rows));

/** Return (normal, -offset) of each triangle in its object's space, from the middle of its box: 4 each. @param {Scene} scene */
export function trianglePlanes(scene) {
  const { faces, vertices, faceObject } = scene, planes = new Float64Array(4 * faceObject.length);
  let object = -1, middle = /** @type {Vec} */ ([0, 0, 0]);
  for (let n = 0; n < faceObject.length; n += 1) {
    if (faceObject[n] !== object) {
      object = faceObject[n];
      middle = placeOfObject(scene, object).middle;
    }
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * faces[3 * n + k];
      return minus([vertices[at], vertices[at + 1], vertices[at + 2]], middle);
    });
    const normal = cross(minus(b, a), minus(c, a));
    planes.set([...normal, -dot(normal, a)], 4 * n);
  }
  return planes;
}

/** Return image coordinates of a camera: see ImageSpace in setup.py. @param {RasterView} view @param {Scene} scene */
export function imageSpace({ camera, size: [width, height] }, scene) {
  const [left, right, bottom, top] = camera.viewport, parallel = isParallel(camera);
  const x = (left + right) / 2, y = (bottom + top) / 2, unit = parallel ? 1 : camera.distance;
  const [rowU, rowV, rowW] = inverseRows(camera.u, camera.v, camera.w), tRow = times(-1 / unit, rowW);
  const fitted = fittedRanges(camera, scene, tRow);
  const across = plus(times(x, camera.u), times(y, camera.v));
  // Pixels per unit of the image plane; in perspective x and y are multiplied by t.
  const perX = width / (right - left), perY = height / (top - bottom);
  /** @param {number} middle */
  const shift = (middle) => (parallel ? -middle : 0);
  const rowX = parallel ? rowU : minus(rowU, times(x, tRow)), rowY = parallel ? rowV : minus(rowV, times(y, tRow));
  const [near, far] = fitted.box;
  return {
    rows: [times(perX, rowX), times(perY, rowY), tRow],
    shifts: /** @type {Vec} */ ([perX * shift(x), perY * shift(y), 0]),
    stepX: times((right - left) / width, camera.u),
    stepY: times((top - bottom) / height, camera.v),
    across: parallel ? across : /** @type {Vec} */ ([0, 0, 0]),
    direction: parallel ? times(-1, camera.w) : minus(across, times(camera.distance, camera.w)),
    clipZ: parallel ? [2 / (far - near), -(far + near) / (far - near)] : [1, 0],
    near: fitted.near,
    tLow: fitted.tLow,
    tHigh: fitted.tHigh,
  };
}

/** @typedef {ReturnType<typeof imageSpace>} ImageSpace */

/** Return image coordinates of a point relative to the eye. @param {ImageSpace} space @param {Vec} fromEye @returns {Vec} */
const inImage = (space, fromEye) => plus(applied(space.rows, fromEye), space.shifts);

/** Return clip ranges as ray parameters, so that clipping is never visible. @param {Camera} camera @param {Scene} scene @param {Vec} tRow */
function fittedRanges(camera, scene, tRow) {
  const count = objectCount(scene), near = new Float64Array(count).fill(1);
  const seenSpheres = new Set(scene.sphereObject);
  let lowest = Infinity, highest = -Infinity, tLow = Infinity;
  for (let k = 0; k < count; k += 1) {
    const { rows, place, low, high, middle } = placeOfObject(scene, k);
    const at = dot(plus(applied(rows, middle), minus(place, camera.eye)), tRow);
    const own = applied(transposed(rows), tRow), size = minus(high, low);
    const half = (Math.abs(own[0]) * size[0] + Math.abs(own[1]) * size[1] + Math.abs(own[2]) * size[2]) / 2;
    const tMin = at - half, tMax = at + half;
    if (!(scene.objectFaces[2 * k + 1] > 0 || seenSpheres.has(k))) continue;
    [lowest, highest] = [Math.min(lowest, tMin), Math.max(highest, tMax)];
    const least = tMax > 0 ? Math.max(NEAREST_CLIP * tMax, TINY) : 1;
    near[k] = Math.max(tMin / 2, least);
    if (tMax > 0) tLow = Math.min(tLow, Math.max(0.99 * tMin, least));
  }
  const parallel = isParallel(camera);
  if (tLow === Infinity) return { near: near.fill(parallel ? 0 : 1), box: [1, 2], tLow: TINY, tHigh: 2 * TINY };
  const span = Math.max(highest - lowest, 1e-3 * Math.max(Math.abs(lowest), Math.abs(highest)), TINY);
  const box = [lowest - span, highest + span];
  return { near: parallel ? near.fill(0) : near, box, tLow, tHigh: Math.max(1.01 * highest, TINY) };
}

/** Return the uniform block of shaders/chunks/camera.glsl. @param {RasterView} view @param {ImageSpace} space @param {Scene} scene */
export function cameraBlock({ camera, size, unit }, space, scene) {
  const block = new Float32Array(48), whole = new Int32Array(block.buffer);
  transposed(space.rows).forEach((column, k) => block.set(column, 4 * k));
  const [tMin, tMax] = parameterRange(camera);
  let low = space.tLow, high = space.tHigh;
  if (!unit) [low, high] = [Math.max(low, 0.99 * tMin), Math.min(high, 1.01 * tMax)];
  else {
    const edges = camera.viewport.map((edge) => edge / camera.distance);
    const steps = [(edges[1] - edges[0]) / size[0], (edges[3] - edges[2]) / size[1]];
    block.set([(edges[0] + edges[1]) / 2, (edges[2] + edges[3]) / 2, ...steps, ...unit], 40);
  }
  const [depthLow, depthHigh] = new Int32Array(Float32Array.of(low, Math.max(high, 2 * low)).buffer);
  block.set([...space.stepX, isParallel(camera) ? 0 : 1], 12);
  block.set([...space.stepY, 1 / (depthHigh - depthLow)], 16);
  block.set(space.direction, 20);
  whole[23] = depthLow;
  block.set(scene.background, 24);
  whole[27] = scene.lights.length / 8;
  block.set(scene.ambient, 28);
  block.set([size[0] / 2, size[1] / 2, Math.min(tMin, FLOAT32_MAX), Math.min(tMax, FLOAT32_MAX)], 32);
  block.set([size[0] / 2 + marginOf(size[0]), size[1] / 2 + marginOf(size[1]), ...space.clipZ], 36);
  return block;
}

/**
 * Store the coefficients of triangles, 4 numbers each: t (parallel) or 1/t (perspective) of the ray
 * of pixel (x, y) is c0 x + c1 y + c2.
 * @param {Scene} scene @param {Float64Array} planes @param {Camera} camera @param {ImageSpace} space
 * @param {Float32Array} out
 */
export function triangleRows(scene, planes, camera, space, out) {
  const parallel = isParallel(camera), count = scene.faceObject.length;
  let object = -1, single = false, bases = /** @type {Vec[]} */ ([]);
  for (let n = 0; n < count; n += 1) {
    if (scene.faceObject[n] !== object) {
      object = scene.faceObject[n];
      single = scene.singleSided[object] > 0;
      const { rows, place, middle } = placeOfObject(scene, object), inverse = inverted(rows);
      const start = applied(inverse, minus(plus(camera.eye, space.across), place));
      bases = [space.stepX, space.stepY, space.direction].map((vector) => applied(inverse, vector));
      bases.push(minus(start, middle));
    }
    const a = planes[4 * n], b = planes[4 * n + 1], c = planes[4 * n + 2], d = planes[4 * n + 3];
    const [x, y, z, start] = bases;
    const p0 = a * x[0] + b * x[1] + c * x[2], p1 = a * y[0] + b * y[1] + c * y[2];
    const p2 = a * z[0] + b * z[1] + c * z[2], p3 = a * start[0] + b * start[1] + c * start[2] + d;
    const scale = -(parallel ? p2 : p3), c0 = p0 / scale, c1 = p1 / scale, c2 = (parallel ? p3 : p2) / scale;
    const isUnseen = !(Math.abs(c0) + Math.abs(c1) + Math.abs(c2) < 1e30) || (single && (parallel ? scale < 0 : scale > 0));
    out[4 * n] = isUnseen ? 0 : c0;
    out[4 * n + 1] = isUnseen ? 0 : c1;
    out[4 * n + 2] = isUnseen ? -1 : c2;
  }
}

/** Return the point of the scene's bounds that is nearest to the eye. @param {Scene} scene @param {Vec} eye @returns {Vec} */
const nearPoint = ({ bounds }, eye) => /** @type {Vec} */ (eye.map((x, k) => Math.min(Math.max(x, bounds[k]), bounds[3 + k])));

/** Return OBJECT_TEXELS texels of each object. @param {Scene} scene @param {Camera} camera @param {ImageSpace} space */
export function objectRows(scene, camera, space) {
  const count = objectCount(scene), out = new Float32Array(4 * OBJECT_TEXELS * count);
  const near = nearPoint(scene, camera.eye), { cells, materials } = scene;
  for (let k = 0; k < count; k += 1) {
    const { rows, place, low, high } = placeOfObject(scene, k), at = 4 * OBJECT_TEXELS * k;
    const eye = applied(inverted(rows), minus(camera.eye, place));
    // Round the anchor first: the difference from a vertex then has no other rounding.
    const anchor = /** @type {Vec} */ (eye.map((x, n) => Math.fround(Math.min(Math.max(x, low[n]), high[n]))));
    const turned = applied(rows, anchor);
    out.set([...anchor, space.near[k]], at);
    out.set(inImage(space, plus(turned, minus(place, camera.eye))), at + 4);
    out.set(plus(turned, minus(place, near)), at + 8);
    const columns = transposed(rows);
    for (let n = 0; n < 3; n += 1) {
      out.set(columns.map((column) => dot(space.rows[n], column)), at + 12 + 4 * n);
      out.set(rows[n], at + 24 + 4 * n);
    }
    out.set(materials.subarray(12 * k, 12 * k + 12), at + 36);
    const cellRows = [0, 1, 2].map((n) => Array.from(cells.subarray(12 * k + 4 * n, 12 * k + 4 * n + 4)));
    if (materials[12 * k + 7] === 1) out[at + 47] = dot(/** @type {any} */ (cellRows[0]), columns[0]);
    cellRows.forEach((row, n) => {
      const cell = dot(/** @type {any} */ (row), plus(turned, place)) + row[3];
      out.set([row[0], row[1], row[2], cell - 2 * Math.floor(cell / 2)], at + 48 + 4 * n);
    });
  }
  return out;
}

/** Return the lights, with points relative to the scene's near point. @param {Scene} scene @param {Camera} camera */
export function lightRows(scene, camera) {
  const rows = Float64Array.from(scene.lights), near = nearPoint(scene, camera.eye);
  for (let at = 0; at < rows.length; at += 8) for (let k = 0; k < 3; k += 1) rows[at + k] -= rows[at + 3] * near[k];
  return Float32Array.from(rows);
}

/** Return SPHERE_TEXELS texels of each sphere. @param {Scene} scene @param {Camera} camera @param {ImageSpace} space @param {Float32Array} objects */
export function sphereRows(scene, camera, space, objects) {
  const rows = new Float32Array(4 * SPHERE_TEXELS * scene.sphereObject.length);
  scene.sphereObject.forEach((object, n) => {
    const radius = scene.spheres[4 * n + 3], at = 4 * OBJECT_TEXELS * object;
    const center = /** @type {Vec} */ (Array.from(scene.spheres.subarray(4 * n, 4 * n + 3)));
    const toCenter = minus(center, camera.eye), fromCenter = minus(space.across, toCenter), far = length(fromCenter);
    rows.set([...inImage(space, toCenter), radius], 12 * n);
    rows.set([...fromCenter, (far - radius) * (far + radius)], 12 * n + 4);
    rows.set([-objects[at], -objects[at + 1], -objects[at + 2], object], 12 * n + 8);
  });
  return rows;
}
