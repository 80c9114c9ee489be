// The outside view: the scene, the camera in it, its viewport and frustum, and one viewing ray.

import { cameraForSize, imagePoint, isParallel, project, viewingRay } from "./camera.js";
import { element, svgElement } from "./elements.js";
import { addNavigation } from "./image_view.js";
import { orbited, panned, zoomed } from "./navigation.js";
import { placeOfObject } from "./setup.js";
import { objectCount } from "./scene.js";
import { cross, dot, length, minus, normalized, plus, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./raster.js").Raster} Raster */
/** @typedef {{camera?: Camera, basis?: boolean, volume?: boolean, ray?: boolean}} OutsideParts */
/** @typedef {{origin: Vec, direction: Vec, t: number}} ShownRay t: of its hit, Infinity for none */

const FOV = 0.7; // radians
const WIDTH = 640, HEIGHT = 420;
const EDGES = [[0, 1], [1, 3], [3, 2], [2, 0], [4, 5], [5, 7], [7, 6], [6, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

/** Return a camera that sees the scene and the eye from aside. @param {Camera} camera @param {Scene} scene @returns {Camera} */
function outsideCamera(camera, scene) {
  const low = /** @type {Vec} */ (Array.from(scene.focus.subarray(0, 3))), high = /** @type {Vec} */ (Array.from(scene.focus.subarray(3, 6)));
  const middle = times(0.5, plus(low, high)), center = times(0.5, plus(middle, camera.eye));
  const radius = Math.max(length(minus(high, low)) / 2.4, length(minus(camera.eye, middle)) / 1.8);
  const w = normalized(plus(plus(times(0.8, normalized(camera.u)), [0, 0.55, 0]), times(0.45, normalized(camera.w))));
  const u = normalized(cross([0, 1, 0], w)), half = Math.tan(FOV / 2), aspect = WIDTH / HEIGHT;
  return {
    eye: plus(center, times(radius / Math.sin(FOV / 2), w)),
    u, v: cross(w, u), w, distance: 1, projection: "perspective",
    viewport: [-half * aspect, half * aspect, -half, half],
  };
}

/**
 * Return the view, and a function that draws a camera and a ray in it.
 * @param {Camera} first @param {Scene} scene
 * @param {(canvas: HTMLCanvasElement) => Raster | undefined} newRaster draws the scene; undefined without WebGL
 * @param {OutsideParts} [parts] the camera that looks, by default one that sees all, and what is drawn
 */
export function outsideView(first, scene, newRaster, parts = {}) {
  const canvas = element("canvas", { width: String(WIDTH), height: String(HEIGHT), "aria-hidden": "true" });
  const drawing = svgElement("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, tabindex: 0, role: "img" });
  const stage = element("div", { class: "lucida-stage" }, canvas);
  stage.append(drawing);
  const view = element("figure", { class: "lucida-image lucida-outside" }, stage, element("figcaption", {}, "Outside view: the camera in the scene"));
  const raster = newRaster(canvas);
  let outside = parts.camera ?? outsideCamera(first, scene);
  let last = /** @type {{camera: Camera, size: Size, ray: ShownRay | null}} */ ({ camera: first, size: [3, 2], ray: null });
  const size = /** @type {Size} */ ([WIDTH, HEIGHT]);
  const pivot = /** @type {Vec} */ ([0, 1, 2].map((k) => (scene.focus[k] + scene.focus[3 + k]) / 2));

  const drawScene = () => raster?.show(outside, size, 0);
  const drawLines = () => {
    const boxes = raster ? [] : boxLines(scene, outside);
    drawing.replaceChildren(...boxes, ...cameraLines(last, outside, scene, parts));
    const { eye, w, distance } = last.camera;
    const numbers = [eye, w].map((a) => a.map((x) => x.toFixed(2)).join(", "));
    drawing.setAttribute("aria-label", `The camera from outside: eye at ${numbers[0]}, looking against w, ${numbers[1]}, viewport at distance ${distance.toFixed(2)}`);
  };
  /** @param {Camera} next */
  const move = (next) => {
    outside = next;
    drawScene();
    drawLines();
  };
  addNavigation(/** @type {any} */ (drawing), {
    orbit: (x, y) => move(orbited(outside, pivot, -3 * x, -2 * y)),
    pan: (x, y) => move(panned(outside, pivot, x, y)),
    zoom: (factor) => move(zoomed(outside, pivot, factor)),
    mark: () => undefined,
    step: () => undefined,
  });
  drawScene();
  return {
    view,
    /** @param {Camera} camera @param {Size} imageSize @param {ShownRay | null} ray */
    show(camera, imageSize, ray) {
      last = { camera: cameraForSize(camera, imageSize), size: imageSize, ray };
      drawLines();
    },
    dispose: () => raster?.dispose(),
  };
}

/**
 * Return a line of the world as seen from outside; null where none of it is in front.
 * @param {Camera} outside @param {Vec} a @param {Vec} b @param {string} kind
 */
function worldLine(outside, a, b, kind) {
  const near = 0.01, [da, db] = [a, b].map((p) => dot(minus(outside.eye, p), outside.w));
  if (da < near && db < near) return null;
  if (da < near) a = plus(b, times((db - near) / (db - da), minus(a, b)));
  if (db < near) b = plus(a, times((da - near) / (da - db), minus(b, a)));
  const [p, q] = [a, b].map((point) => project(outside, point, [WIDTH, HEIGHT]));
  return svgElement("line", { class: kind, x1: p.column, y1: p.row, x2: q.column, y2: q.row });
}

/** Return lines along the boxes of all objects. @param {Scene} scene @param {Camera} outside */
function boxLines(scene, outside) {
  const lines = [];
  for (let k = 0; k < Math.min(objectCount(scene), 200); k += 1) {
    const { rows, place, low, high } = placeOfObject(scene, k);
    const corners = Array.from({ length: 8 }, (_, n) => {
      const own = /** @type {Vec} */ ([0, 1, 2].map((axis) => ((n >> axis) & 1 ? high : low)[axis]));
      return plus(place, /** @type {Vec} */ (rows.map((row) => dot(row, own))));
    });
    lines.push(...EDGES.map(([a, b]) => worldLine(outside, corners[a], corners[b], "box")));
  }
  return lines.filter((line) => line !== null);
}

/** Return the drawn eye, basis, viewport, frustum and ray. @param {{camera: Camera, size: Size, ray: ShownRay | null}} shown @param {Camera} outside @param {Scene} scene @param {OutsideParts} drawn */
function cameraLines({ camera, size, ray }, outside, scene, drawn) {
  const { eye, u, v, w, distance } = camera, [width, height] = size;
  const reach = length(/** @type {Vec} */ ([0, 1, 2].map((k) => scene.focus[3 + k] - scene.focus[k])));
  const back = isParallel(camera) ? /** @type {Vec} */ ([0, 0, 0]) : times(distance, w);
  /** Return a point of the viewport. @param {number} i @param {number} j */
  const onViewport = (i, j) => {
    const [x, y] = imagePoint(camera, i, j, size);
    return minus(plus(eye, plus(times(x, u), times(y, v))), back);
  };
  const ends = /** @type {[number, number][]} */ ([[-0.5, -0.5], [-0.5, width - 0.5], [height - 0.5, width - 0.5], [height - 0.5, -0.5]]);
  const parts = ends.map((end, k) => worldLine(outside, onViewport(...end), onViewport(...ends[(k + 1) % 4]), "viewport"));
  for (const end of drawn.volume === false ? [] : ends) {
    const { origin, direction } = viewingRay(camera, ...end, size);
    if (Number.isNaN(direction[0])) continue;
    parts.push(worldLine(outside, origin, plus(origin, times(1.2 * reach, normalized(direction))), "frustum"));
  }
  for (const [name, vector] of /** @type {[string, Vec][]} */ (drawn.basis === false ? [] : [["u", u], ["v", v], ["w", w]])) {
    // A lecture's camera was found for vectors of their own length.
    const tip = plus(eye, drawn.camera ? vector : times(0.15 * reach, normalized(vector)));
    parts.push(worldLine(outside, eye, tip, `basis ${name}`), worldLabel(outside, tip, name, `label ${name}`));
  }
  if (ray && drawn.ray !== false) {
    const t = Number.isFinite(ray.t) ? ray.t : (1.5 * reach) / length(ray.direction), end = plus(ray.origin, times(t, ray.direction));
    parts.push(worldLine(outside, ray.origin, end, "ray"));
    if (Number.isFinite(ray.t)) parts.push(worldDot(outside, end, "hit"));
  }
  parts.push(worldDot(outside, eye, "eye"), worldLabel(outside, eye, "e", "label eye"));
  return parts.filter((part) => part !== null);
}

/** @param {Camera} outside @param {Vec} point @param {string} kind */
function worldDot(outside, point, kind) {
  const { row, column } = project(outside, point, [WIDTH, HEIGHT]);
  return Number.isNaN(row) ? null : svgElement("circle", { class: kind, cx: column, cy: row, r: 5 });
}

/** @param {Camera} outside @param {Vec} point @param {string} text @param {string} kind */
function worldLabel(outside, point, text, kind) {
  const { row, column } = project(outside, point, [WIDTH, HEIGHT]);
  return Number.isNaN(row) ? null : svgElement("text", { class: kind, x: column + 7, y: row - 7 }, text);
}
