// The pinhole images in which a rasterizer sees what a lens shows. No projection matrix holds a
// lens, so it draws faces: one where a pinhole sees all that the lens sees, else up to six faces of
// a cube around the eye. Each pixel looks up the texel in which its ray ends. The same faces as
// renderer/lens_faces.py.

import { viewingRay } from "./camera.js";
import { lensOf } from "./lens.js";
import { dot, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {{views: import("./setup.js").RasterView[], positions: Float32Array}} Faces positions: 4 for each pixel, the place on its face in texels from the middle, its face's number (-1: none) */

const WIDEST = 2; // one pinhole image reaches to this tangent
const MOST_SIDE = 4096, ENLARGEMENT = 2, OUTSIDE = -1;

/** The faces' u, v, w in units of the camera's. @type {[Vec, Vec, Vec][]} */
const CUBE = [
  [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
  [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
  [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  [[-1, 0, 0], [0, 0, 1], [0, 1, 0]],
  [[-1, 0, 0], [0, 1, 0], [0, 0, -1]],
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
];
const AHEAD = 5;

/** @type {{key: string, planes: ReturnType<typeof facePlanes>} | null} */
let lastPlanes = null;

/** Return the faces for an image of a camera with a lens. @param {Camera} camera @param {Size} size @returns {Faces} */
export function facesOfLens(camera, size) {
  const key = JSON.stringify([camera.lens, camera.viewport, camera.distance, size]);
  if (lastPlanes?.key !== key) lastPlanes = { key, planes: facePlanes(camera, size) };
  const { parts, positions } = lastPlanes.planes;
  const lens = lensOf(/** @type {any} */ (camera.lens)), basis = [camera.u, camera.v, camera.w];
  const lengths = /** @type {Vec} */ ([lens.length(1, 0, 0), lens.length(0, 1, 0), lens.length(0, 0, 1)]);
  const views = parts.map(({ turn, box, size: side }) => {
    const [u, v, w] = turn.map((own) => own.map((s, k) => times(s, basis[k])).reduce(plus));
    const viewport = /** @type {Camera["viewport"]} */ (box.map((edge) => camera.distance * edge));
    const unit = /** @type {Vec} */ (turn.map((own) => dot(/** @type {Vec} */ (own.map(Math.abs)), lengths)));
    return { camera: { ...camera, u, v, w, viewport, lens: undefined, fit: false }, size: side, unit };
  });
  return { views, positions };
}

/** @param {Camera} camera @param {Size} size */
function facePlanes(camera, [width, height]) {
  const own = { ...camera, eye: /** @type {Vec} */ ([0, 0, 0]), u: CUBE[AHEAD][0], v: CUBE[AHEAD][1], w: CUBE[AHEAD][2] };
  const directions = Array.from({ length: width * height }, (_, n) =>
    viewingRay(own, Math.floor(n / width), n % width, [width, height]).direction);
  const isNarrow = directions.every(([x, y, z]) => Number.isNaN(x) || (Math.abs(x) <= -WIDEST * z && Math.abs(y) <= -WIDEST * z));
  const places = directions.map((d) => placeOnFace(d, isNarrow));
  const lows = CUBE.map(() => [Infinity, Infinity]), highs = CUBE.map(() => [-Infinity, -Infinity]);
  for (const { number, place } of places) {
    if (number < 0) continue;
    for (let k = 0; k < 2; k += 1) {
      lows[number][k] = Math.min(lows[number][k], place[k]);
      highs[number][k] = Math.max(highs[number][k], place[k]);
    }
  }
  const [left, right, bottom, top] = camera.viewport, scale = camera.distance * ENLARGEMENT;
  const texel = [(right - left) / width / scale, (top - bottom) / height / scale];
  const spans = highs.map((high, n) => high.map((h, k) => h - lows[n][k]));
  const factor = Math.max(1, ...spans.flatMap((span) => span.map((s, k) => s / texel[k] / (MOST_SIDE - 2))));
  texel.forEach((step, k) => (texel[k] = step * factor));
  const used = CUBE.map((_, n) => n).filter((n) => spans[n][0] > -Infinity);
  const parts = used.map((n) => {
    const side = /** @type {Size} */ (spans[n].map((span, k) => Math.ceil(span / texel[k]) + 1));
    const first = lows[n].map((low, k) => low - texel[k] / 2), last = first.map((f, k) => f + texel[k] * side[k]);
    return { turn: CUBE[n], box: [first[0], last[0], first[1], last[1]], size: side };
  });
  const positions = new Float32Array(4 * width * height);
  places.forEach(({ number, place }, at) => {
    const part = used.indexOf(number);
    if (part < 0) return void (positions[4 * at + 2] = OUTSIDE);
    const [x0, x1, y0, y1] = parts[part].box;
    positions.set([(place[0] - (x0 + x1) / 2) / texel[0], (place[1] - (y0 + y1) / 2) / texel[1], part], 4 * at);
  });
  return { parts, positions };
}

/** Return the face that a direction is on, and where on its plane at distance 1. @param {Vec} direction @param {boolean} isNarrow */
function placeOnFace(direction, isNarrow) {
  const [x, y, z] = direction, across = Math.abs(x), up = Math.abs(y), along = Math.abs(z);
  if (Number.isNaN(x)) return { number: -1, place: [0, 0] };
  let number = z > 0 ? 4 : 5;
  if (isNarrow) number = AHEAD;
  else if (across >= up && across >= along) number = x > 0 ? 0 : 1;
  else if (up >= along) number = y > 0 ? 2 : 3;
  const [u, v, w] = CUBE[number], ahead = -dot(w, direction);
  return { number, place: [dot(u, direction) / ahead, dot(v, direction) / ahead] };
}
