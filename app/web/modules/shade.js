// The colour at a hit: the surface's normals, its albedo, and Blinn and Phong's shading in linear
// light. The same model as renderer/trace/reference/shade.py and shaders/chunks/shading.glsl.

import { CELL_NUDGE, CHECKERED, GRAZING, NEAREST_LIGHT, OTHER_SIDE, SHORTEST_HALF, SHORTEST_MEAN, TEXTURED } from "./numbers.js";
import { edgesOfTriangle, lightAtPlace, placeOnSphere, placeOnTriangle } from "./texture.js";
import { objectOf } from "./scene.js";
import { cross, dot, eachTimes, isZero, length, minus, normalized, plus, times } from "./vectors.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./hierarchy.js").RayHit} RayHit */
/**
 * What a ray sees.
 * @typedef {object} Surface
 * @property {number} object
 * @property {Vec} point
 * @property {Vec} geometric unit normal on the viewer's side
 * @property {Vec} normal the same for shading: interpolated
 * @property {Vec} albedo diffuse reflectance
 * @property {Vec} specular
 * @property {number} shininess
 */

const BLACK = /** @type {Vec} */ ([0, 0, 0]);

/** @param {ArrayLike<number>} array @param {number} at @returns {Vec} */
const tripleAt = (array, at) => [array[at], array[at + 1], array[at + 2]];

/**
 * Return the surface at a hit of the ray from origin.
 * @param {Scene} scene @param {Vec} origin @param {Vec} direction @param {RayHit} hit @returns {Surface}
 */
export function surfaceAt(scene, origin, direction, hit) {
  const object = objectOf(scene, hit.primitive), point = plus(origin, times(hit.t, direction));
  const triangles = scene.faceObject.length, isSphere = hit.primitive >= triangles;
  const { geometric, normal, outward } = isSphere
    ? sphereNormals(scene, hit.primitive - triangles, direction, point)
    : triangleNormals(scene, hit, direction);
  const m = 12 * object, { materials, textures } = scene, pattern = materials[m + 7];
  let albedo = tripleAt(materials, m), specular = tripleAt(materials, m + 4);
  if (pattern === CHECKERED && isOtherCell(scene, object, point, geometric)) albedo = tripleAt(materials, m + 8);
  if (pattern === TEXTURED) {
    const place = isSphere
      ? placeOnSphere(scene, object, outward)
      : placeOnTriangle(scene, hit.primitive, hit.b1, hit.b2);
    albedo = eachTimes(albedo, lightAtPlace(scene, object, textures[8 * object], place));
    const gloss = textures[8 * object + 4];
    if (gloss >= 0) specular = eachTimes(specular, lightAtPlace(scene, object, gloss, place));
  }
  if (!isSphere && scene.colors.length) albedo = eachTimes(albedo, meanOfCorners(scene, scene.colors, hit));
  return { object, point, geometric, normal: notGrazing(normal, direction), albedo, specular, shininess: materials[m + 3] };
}

/** @param {Scene} scene @param {number} sphere @param {Vec} direction @param {Vec} point */
function sphereNormals({ spheres }, sphere, direction, point) {
  const outward = minus(point, tripleAt(spheres, 4 * sphere));
  // A tiny sphere far away may round to its centre.
  const geometric = facing(normalized(isZero(outward) ? direction : outward), direction);
  return { geometric, normal: geometric, outward };
}

/** @param {Scene} scene @param {RayHit} hit @param {Vec} direction */
function triangleNormals(scene, hit, direction) {
  const [toB, toC] = edgesOfTriangle(scene, hit.primitive), { normals, faces } = scene;
  const across = normalized(cross(toB, toC)), geometric = facing(across, direction);
  const flat = { geometric, normal: geometric, outward: BLACK };
  if (!normals.length) return flat;
  const own = [0, 1, 2].map((k) => tripleAt(normals, 3 * faces[3 * hit.primitive + k]));
  if (own.some(isZero)) return flat;
  const smooth = meanOfCorners(scene, normals, hit), size = length(smooth);
  if (size < SHORTEST_MEAN) return flat;
  // Normals that disagree with the winding are turned, for the whole triangle alike.
  let turn = dot(plus(own[0], plus(own[1], own[2])), across) >= OTHER_SIDE ? 1 : -1;
  if (dot(across, direction) >= 0) turn = -turn;
  return { geometric, normal: times(turn / size, smooth), outward: BLACK };
}

/** Return what a triangle's corners have, interpolated. @param {Scene} scene @param {Float32Array} values @param {RayHit} hit @returns {Vec} */
function meanOfCorners({ faces }, values, { primitive, b1, b2 }) {
  const [a, b, c] = [0, 1, 2].map((k) => tripleAt(values, 3 * faces[3 * primitive + k]));
  return plus(times(1 - b1 - b2, a), plus(times(b1, b), times(b2, c)));
}

/** @param {Vec} normal @param {Vec} direction @returns {Vec} */
const facing = (normal, direction) => (dot(normal, direction) < 0 ? normal : times(-1, normal));

/** Return a normal bent just enough to face the viewer. @param {Vec} normal @param {Vec} direction @returns {Vec} */
function notGrazing(normal, direction) {
  const along = normalized(direction), cosine = dot(normal, along);
  return cosine > -GRAZING ? normalized(minus(normal, times(cosine + GRAZING, along))) : normal;
}

/** Return whether a point is in a cell of odd number, just below the surface. @param {Scene} scene @param {number} object @param {Vec} point @param {Vec} geometric */
function isOtherCell({ cells }, object, point, geometric) {
  const rows = [0, 1, 2].map((k) => tripleAt(cells, 12 * object + 4 * k));
  const across = normalized(/** @type {Vec} */ (rows.map((row) => dot(row, geometric))));
  const odd = rows.map((row, k) => {
    const place = dot(row, point) + cells[12 * object + 4 * k + 3] - CELL_NUDGE * across[k];
    return place - 2 * Math.floor(place / 2) >= 1;
  });
  return odd[0] !== odd[1] !== odd[2];
}

/**
 * Return each light as a surface sees it: its colour, the unit vectors to it and half way to the
 * viewer, its distance, and their cosines with the normal.
 * @param {Scene} scene @param {Surface} surface @param {Vec} direction of the viewing ray
 */
export function lightsAt({ lights }, { point, normal }, direction) {
  const along = normalized(direction), found = [];
  for (let at = 0; at < lights.length; at += 8) {
    let toLight = tripleAt(lights, at), distance = Infinity;
    if (lights[at + 3] !== 0) {
      toLight = minus(toLight, point);
      distance = length(toLight);
      if (distance < NEAREST_LIGHT) continue;
      toLight = times(1 / distance, toLight);
    }
    const sum = minus(toLight, along), size = length(sum);
    const half = size >= SHORTEST_HALF ? times(1 / size, sum) : BLACK;
    const cosines = { diffuse: Math.max(0, dot(normal, toLight)), highlight: Math.max(0, dot(normal, half)) };
    found.push({ color: tripleAt(lights, at + 4), toLight, distance, half, cosines });
  }
  return found;
}

/**
 * Return the light that a surface sends to the viewer: ambient, diffuse and highlights.
 * @param {Scene} scene @param {Surface} surface @param {Vec} direction of the viewing ray
 * @param {(toLight: Vec, distance: number) => boolean} isLit @returns {Vec}
 */
export function colorAt(scene, surface, direction, isLit) {
  const { albedo, specular, shininess } = surface, isShiny = !isZero(specular);
  let color = eachTimes(tripleAt(scene.ambient, 0), albedo);
  for (const light of lightsAt(scene, surface, direction)) {
    if (!isLit(light.toLight, light.distance)) continue;
    const diffuse = times(light.cosines.diffuse, eachTimes(light.color, albedo));
    color = plus(color, diffuse);
    if (isShiny) color = plus(color, times(light.cosines.highlight ** shininess, eachTimes(light.color, specular)));
  }
  return color;
}
