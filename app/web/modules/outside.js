// The outside view: the scene, the camera in it, its viewport and frustum, and one viewing ray.

import { cameraForSize, imagePlanePoint, imagePoint, isParallel, parameterRange, project, viewingRay } from "./camera.js";
import { element, numberText, svgElement, vectorText } from "./elements.js";
import { cameraHandles, handleLayer, objectHandles } from "./handles.js";
import { shiftObjects } from "./hiding.js";
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
/**
 * @typedef {object} OutsideParts
 * @property {Camera} [camera] that looks; by default one that sees all
 * @property {boolean} [basis] @property {boolean} [volume] @property {boolean} [ray] what is drawn; by default all
 * @property {import("./handles.js").Kind} [handles] @property {Vec} [target] @property {Vec} [up] what makes the basis
 * @property {import("./handles.js").Movable} [object] of the scene, to be moved
 * @property {boolean} [image] whether the viewport is drawn
 */
/** @typedef {{origin: Vec, direction: Vec, t: number}} ShownRay t: of its hit, Infinity for none */
/** @typedef {{camera: Camera, size: Size, ray: ShownRay | null}} Shown camera: fitted to the image's size */

const TITLE = "Outside view: the camera in the scene";
const FOV = 0.7; // radians
const WIDTH = 640, HEIGHT = 420;
const EDGES = [[0, 1], [1, 3], [3, 2], [2, 0], [4, 5], [5, 7], [7, 6], [6, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

/** Return a camera that sees the scene and the eye from aside. @param {Camera} camera @param {Scene} scene @returns {Camera} */
function outsideCamera(camera, scene) {
  const low = /** @type {Vec} */ (Array.from(scene.focus.subarray(0, 3))), high = /** @type {Vec} */ (Array.from(scene.focus.subarray(3, 6)));
  const middle = times(0.5, plus(low, high)), center = times(0.5, plus(middle, camera.eye));
  const tips = [camera.u, camera.v, camera.w].map((vector) => length(minus(plus(camera.eye, times(scene.arrow, vector)), center)));
  const radius = Math.max(length(minus(high, low)) / 2.4, length(minus(camera.eye, middle)) / 1.8, ...tips);
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
 * @param {OutsideParts} parts
 * @param {(fields: Partial<Camera>) => void} change is asked for another camera
 * @param {(place: Vec) => void} shifted is told where the scene's object was moved
 */
export function outsideView(first, scene, newRaster, parts, change, shifted) {
  const canvas = element("canvas", { width: String(WIDTH), height: String(HEIGHT), "aria-hidden": "true" });
  const drawing = svgElement("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, tabindex: 0, role: "img" });
  const stage = element("div", { class: "lucida-stage" }, canvas);
  stage.append(drawing);
  const caption = element("figcaption", {}, TITLE);
  const view = element("figure", { class: "lucida-image lucida-outside" }, stage, caption);
  const raster = newRaster(canvas);
  let outside = parts.camera ?? outsideCamera(first, scene);
  let last = /** @type {Shown} */ ({ camera: first, size: [3, 2], ray: null });
  const size = /** @type {Size} */ ([WIDTH, HEIGHT]);
  const handles = handleLayer(WIDTH, HEIGHT, (point) => {
    const { row, column } = project(outside, point, size);
    return Number.isNaN(row) ? null : [column, row];
  });
  if (parts.handles || parts.object) stage.append(handles.layer);
  let up = parts.up ?? /** @type {Vec} */ ([0, 1, 0]);
  const pivot = /** @type {Vec} */ ([0, 1, 2].map((k) => (scene.focus[k] + scene.focus[3 + k]) / 2));

  const drawScene = () => raster?.show(outside, size, 0);
  const drawLines = () => {
    const boxes = raster ? [] : boxLines(scene, outside);
    const fails = parts.target !== undefined && length(cross(up, last.camera.w)) < 1e-9 * length(up) * length(last.camera.w);
    drawing.replaceChildren(...boxes, ...cameraLines(last, outside, scene, { ...parts, up, fails }));
    const reach = length(minus(outside.eye, parts.object?.place ?? last.camera.eye)) * Math.tan(FOV / 2) * 1.6;
    const moved = cameraHandles(parts.handles, last.camera, reach, up, (fields, turned = up) => {
      up = turned;
      change(fields);
    });
    handles.show([...moved, ...(parts.object ? objectHandles(parts.object, reach, (by) => {
      if (!parts.object) return;
      shiftObjects(scene, parts.object.objects, by);
      parts.object.place = plus(parts.object.place, by);
      move(outside);
      shifted(parts.object.place);
    }) : [])]);
    caption.textContent = captionOf(last, parts, fails);
    drawing.setAttribute("aria-label", described(last, parts, up));
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

/** Return what is said below the view. @param {Shown} shown @param {OutsideParts} parts @param {boolean} fails */
function captionOf({ camera, size: [width, height] }, { handles }, fails) {
  const [left, right, bottom, top] = camera.viewport, { distance } = camera;
  if (fails) return `${TITLE}. up x w = 0: no u, no v`;
  if (handles !== "pixels") return TITLE;
  const [x, y] = [width / (right - left), height / (top - bottom)], focal = [x * distance, y * distance].map((f) => numberText(f));
  return `${TITLE}. K: f = ${focal[0] === focal[1] ? focal[0] : `(${focal.join(", ")})`}, c = (${numberText(-left * x - 0.5)}, ${numberText(top * y - 0.5)}), from 0 at pixels' centres`;
}

/** Return the view in words. @param {Shown} shown @param {OutsideParts} parts @param {Vec} up */
function described({ camera, ray }, parts, up) {
  const { eye, u, v, w, distance } = camera, said = [`The camera from outside: eye at ${vectorText(eye)}, looking along ${vectorText(times(-1, w))}`];
  said.push(isParallel(camera) ? "parallel" : `image plane at d = ${numberText(distance)}`);
  if (parts.basis !== false) said.push(`u = ${vectorText(u)}, v = ${vectorText(v)}, w = ${vectorText(w)}`);
  if (parts.target) said.push(`target ${vectorText(parts.target)}, up ${vectorText(up)}`);
  if (ray && parts.ray !== false) said.push(`the marked pixel's ray from ${vectorText(ray.origin)} along ${vectorText(ray.direction)} ${Number.isFinite(ray.t) ? `hits at t = ${numberText(ray.t)}` : "hits nothing"}`);
  return said.join("; ");
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

/** Return the drawn eye, basis, viewport, frustum and ray. @param {Shown} shown @param {Camera} outside @param {Scene} scene @param {OutsideParts & {fails: boolean}} drawn */
function cameraLines({ camera, size, ray }, outside, scene, drawn) {
  const { eye, u, v, w } = camera, [width, height] = size;
  const reach = length(/** @type {Vec} */ ([0, 1, 2].map((k) => scene.focus[3 + k] - scene.focus[k])));
  /** Return a point of the viewport. @param {number} i @param {number} j */
  const onViewport = (i, j) => imagePlanePoint(camera, ...imagePoint(camera, i, j, size));
  const ends = /** @type {[number, number][]} */ ([[-0.5, -0.5], [-0.5, width - 0.5], [height - 0.5, width - 0.5], [height - 0.5, -0.5]]);
  const parts = drawn.image === false ? [] : ends.map((end, k) => worldLine(outside, onViewport(...end), onViewport(...ends[(k + 1) % 4]), "viewport"));
  const [near, far] = parameterRange(camera), rays = ends.map((end) => viewingRay(camera, ...end, size));
  /** Return a point of a corner's ray; without far, beyond the scene. @param {number} k @param {number} t */
  const along = (k, t) => plus(rays[k].origin, times(Number.isFinite(t) ? t : (1.2 * reach) / length(rays[k].direction), rays[k].direction));
  for (let k = 0; k < (drawn.volume === false || Number.isNaN(rays[0].direction[0]) ? 0 : 4); k += 1) {
    parts.push(worldLine(outside, rays[k].origin, along(k, far), "frustum"));
    for (const t of [near, far]) if (t > 0 && Number.isFinite(t)) parts.push(worldLine(outside, along(k, t), along((k + 1) % 4, t), "clip"));
    if (near > 0) parts.push(worldLine(outside, along(k, near), along(k, far), "clip"));
  }
  if (drawn.handles === "pixels") {
    for (let i = 1; i < height; i += 1) parts.push(worldLine(outside, onViewport(i - 0.5, -0.5), onViewport(i - 0.5, width - 0.5), "grid"));
    for (let j = 1; j < width; j += 1) parts.push(worldLine(outside, onViewport(-0.5, j - 0.5), onViewport(height - 0.5, j - 0.5), "grid"));
    parts.push(worldLine(outside, eye, imagePlanePoint(camera, 0, 0), "frustum"), worldLabel(outside, onViewport(0, 0), "(0, 0)", "label"));
  }
  if (drawn.target && drawn.up) {
    const tip = plus(eye, drawn.up);
    parts.push(worldLine(outside, eye, drawn.target, "frustum"), worldDot(outside, drawn.target, "target"), worldLabel(outside, drawn.target, "target", "label"));
    parts.push(worldLine(outside, eye, tip, "up"), worldLabel(outside, tip, "up", "label"));
  }
  const basis = /** @type {[string, Vec][]} */ (drawn.basis === false ? [] : [["u", u], ["v", v], ["w", w]]);
  for (const [name, vector] of drawn.fails ? basis.slice(2) : basis) {
    const tip = plus(eye, times(scene.arrow, vector)), text = scene.arrow === 1 ? name : `${scene.arrow} ${name}`;
    parts.push(worldLine(outside, eye, tip, `basis ${name}`), worldLabel(outside, tip, text, `label ${name}`));
  }
  if (ray && drawn.ray !== false) {
    const t = Number.isFinite(ray.t) ? ray.t : (1.5 * reach) / length(ray.direction), end = plus(ray.origin, times(t, ray.direction));
    parts.push(worldLine(outside, ray.origin, end, "ray"));
    if (Number.isFinite(ray.t)) parts.push(worldDot(outside, end, "hit"));
  }
  parts.push(worldDot(outside, eye, "eye"), worldLabel(outside, eye, "e", "label eye"));
  const shown = parts.filter((part) => part !== null);
  return [...shown.filter((part) => part.tagName !== "text"), ...shown.filter((part) => part.tagName === "text")]; // no line across a letter
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
