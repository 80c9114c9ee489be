// Handles of the outside view: what is dragged there by pointer, touch and keys.

import { imagePlanePoint } from "./camera.js";
import { numberText, svgElement, vectorText } from "./elements.js";
import { cross, dot, length, normalized, plus, rotated, times } from "./vectors.js";

/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {"move" | "turn" | "up" | "pixels"} Kind what a lecture lets its class drag */
/**
 * @typedef {object} Handle
 * @property {string} name spoken @property {string} label shown @property {string} kind of its colour
 * @property {number} value along its first axis @property {string} text its value, spoken
 * @property {Vec} at where it begins @property {Vec[]} axes one for an arrow, two for a point
 * @property {(...parts: number[]) => void} move by parts of its axes
 */
/** @typedef {{objects: [number, number], place: Vec, name: string}} Movable objects of the scene that are moved as one, and their middle */

const KEY_PART = 0.05, PARALLEL = 0.02, ARROW = 0.22;
const DIRECTIONS = /** @type {Record<string, [number, number]>} */ ({ ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] });

/**
 * Return the handles of a camera.
 * @param {Kind | undefined} kind @param {Camera} camera fitted to its image @param {number} reach of the scene
 * @param {Vec} up @param {(fields: Partial<Camera>, up?: Vec) => void} change @returns {Handle[]}
 */
export function cameraHandles(kind, camera, reach, up, change) {
  const { eye, u, v, w, viewport } = camera;
  if (kind === "move")
    return (/** @type {const} */ (["u", "v", "w"])).map((name) => {
      const axis = times(ARROW * reach, normalized(camera[name]));
      return {
        name: `Eye along ${name}`, label: name, kind: `basis ${name}`, value: dot(eye, normalized(axis)), text: vectorText(eye), at: eye, axes: [axis],
        move: (part) => change({ eye: plus(eye, times(part, axis)) }),
      };
    });
  if (kind === "turn") {
    const size = ARROW * reach, [right, top] = [normalized(u), normalized(v)];
    return [{
      name: "View direction", label: "", kind: "basis w", value: -w[0], text: vectorText(times(-1, w)), at: plus(eye, times(-size, normalized(w))),
      axes: [times(size, right), times(size, top)],
      move(x, y = 0) {
        /** @param {Vec} one @returns {Vec} */
        const turned = (one) => rotated(rotated(one, top, -x), right, y);
        change({ u: turned(u), v: turned(v), w: turned(w) });
      },
    }];
  }
  if (kind === "up") {
    const around = cross(normalized(w), up), isDefined = length(around) > 1e-9 * length(up);
    const aside = isDefined ? times(length(up) / length(around), around) : times(length(up), normalized(u)), axis = normalized(cross(aside, up));
    return [{
      name: "up", label: "", kind: "up", value: dot(up, normalized(w)), text: vectorText(up), at: plus(eye, up), axes: [aside, times(length(up), cross(normalized(aside), normalized(up)))],
      move(first, second = 0) {
        const turned = rotated(rotated(up, axis, -first), normalized(aside), second);
        change(...withUp(camera, turned));
      },
    }];
  }
  if (kind !== "pixels") return [];
  const corner = imagePlanePoint(camera, viewport[1], viewport[2]), point = imagePlanePoint(camera, 0, 0);
  const aside = imagePlanePoint(camera, (viewport[0] + 3 * viewport[1]) / 4, (viewport[2] + 3 * viewport[3]) / 4);
  /** @param {number} x @param {number} y @returns {Camera["viewport"]} */
  const slid = (x, y) => [viewport[0] + x, viewport[1] + x, viewport[2] + y, viewport[3] + y];
  const numbers = vectorText(viewport);
  return [
    { name: "Grid", label: "grid", kind: "grid", value: viewport[0], text: numbers, at: aside, axes: [u, v], move: (x, y = 0) => change({ viewport: slid(x, y), fit: false }) },
    {
      name: "Corner", label: "f", kind: "corner", value: viewport[1], text: numbers, at: corner, axes: [u, v],
      move(x, y = 0) {
        const [a, b] = [viewport[1], viewport[2]], scale = Math.hypot(a + x, b + y) / Math.max(Math.hypot(a, b), 1e-9);
        change({ viewport: /** @type {Camera["viewport"]} */ (viewport.map((edge) => edge * Math.min(Math.max(scale, 0.1), 10))), fit: false });
      },
    },
    {
      name: "Pixel straight ahead", label: "c", kind: "principal", value: dot(eye, normalized(u)), text: vectorText(eye), at: point, axes: [u, v],
      move: (x, y = 0) => change({ eye: plus(eye, plus(times(x, u), times(y, v))), viewport: slid(-x, -y), fit: false }),
    },
  ];
}

/** Return the basis that `up` makes with w, and up; no basis if both are parallel, or almost. @param {Camera} camera @param {Vec} up @returns {[Partial<Camera>, Vec]} */
function withUp({ u, v, w }, up) {
  const back = normalized(w), across = cross(up, back);
  if (length(across) < PARALLEL * length(up)) return [{}, times(Math.sign(dot(up, back)) * length(up), back)];
  const right = normalized(across);
  return [{ u: times(length(u), right), v: times(length(v), cross(back, right)) }, up];
}

/** Return the arrows that move an object of the scene. @param {Movable} object @param {number} reach of the scene @param {(by: Vec) => void} shift @returns {Handle[]} */
export function objectHandles({ place, name }, reach, shift) {
  return ["x", "y", "z"].map((letter, k) => {
    const axis = /** @type {Vec} */ ([0, 1, 2].map((other) => (other === k ? ARROW * reach : 0)));
    return { name: `${name} along ${letter}`, label: letter, kind: "object", value: place[k], text: vectorText(place), at: place, axes: [axis], move: (part) => shift(times(part, axis)) };
  });
}

/**
 * Return a layer over a view, and a function that shows handles in it.
 * @param {number} width @param {number} height of the view's drawing
 * @param {(point: Vec) => [number, number] | null} project onto the drawing
 */
export function handleLayer(width, height, project) {
  const layer = svgElement("svg", { class: "lucida-handles", viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": "Handles" });
  /** @type {Map<string, ReturnType<typeof grip>>} */
  const grips = new Map();
  return {
    layer,
    /** @param {Handle[]} handles */
    show(handles) {
      for (const handle of handles) {
        const known = grips.get(handle.name) ?? grip([width, height], project, (x) => (x * width) / layer.clientWidth);
        if (!grips.has(handle.name)) layer.append(known.element);
        grips.set(handle.name, known);
        known.show(handle);
      }
    },
  };
}

/** Return one handle's element, which stays while it is dragged. @param {[number, number]} size of the drawing @param {(point: Vec) => [number, number] | null} project @param {(x: number) => number} scaled from CSS pixels to the drawing */
function grip([width, height], project, scaled) {
  const shown = svgElement("path", {}), grab = svgElement("path", { class: "grab" });
  const letter = svgElement("text", {}), element = svgElement("g", { role: "slider", tabindex: 0 }, shown, letter, grab);
  let handle = /** @type {Handle | null} */ (null), held = /** @type {[number, number] | null} */ (null);
  /** Return the handle's axes on the drawing. @returns {[number, number][] | null} */
  const axes = () => {
    const start = handle && project(handle.at), ends = handle?.axes.map((axis) => project(plus(/** @type {Handle} */ (handle).at, axis)));
    return start && ends?.every((end) => end) ? ends.map((end) => [/** @type {any} */ (end)[0] - start[0], /** @type {any} */ (end)[1] - start[1]]) : null;
  };
  element.addEventListener("pointerdown", (event) => {
    event.stopPropagation();
    element.setPointerCapture(event.pointerId);
    element.focus({ preventScroll: true });
    held = [event.clientX, event.clientY];
  });
  element.addEventListener("pointermove", (event) => {
    const way = axes();
    if (!held || !way) return;
    const [x, y] = [scaled(event.clientX - held[0]), scaled(event.clientY - held[1])];
    held = [event.clientX, event.clientY];
    const parts = partsOf(way, x, y);
    if (parts) handle?.move(...parts);
  });
  for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, () => (held = null));
  element.addEventListener("keydown", (event) => {
    const [x, y] = DIRECTIONS[event.key] ?? [0, 0];
    if (!handle || (!x && !y)) return;
    event.preventDefault();
    event.stopPropagation();
    handle.move(...(handle.axes.length === 1 ? [KEY_PART * (x + y)] : [KEY_PART * x, KEY_PART * y]));
  });
  return {
    element,
    /** @param {Handle} next */
    show(next) {
      handle = next;
      const start = project(next.at), way = axes();
      element.setAttribute("visibility", start && way ? "visible" : "hidden");
      if (!start || !way) return;
      element.setAttribute("class", next.kind);
      for (const [name, value] of [["label", next.name], ["valuenow", numberText(next.value)], ["valuetext", next.text]])
        element.setAttribute(`aria-${name}`, value.replaceAll("\u2212", "-"));
      const outline = next.axes.length === 1 ? arrow(start, way[0]) : disc(start);
      for (const path of [shown, grab]) path.setAttribute("d", outline);
      const [x, y] = next.axes.length === 1 ? [start[0] + 1.15 * way[0][0], start[1] + 1.15 * way[0][1]] : [start[0] + 13, start[1] + 6];
      letter.textContent = next.label;
      letter.setAttribute("x", String(Math.min(Math.max(x, 2), width - 16)));
      letter.setAttribute("y", String(Math.min(Math.max(y, 18), height - 4)));
    },
  };
}

/** Return a movement on the drawing as parts of axes; null if an axis is seen end-on. @param {[number, number][]} axes @param {number} x @param {number} y */
function partsOf([a, b], x, y) {
  const square = a[0] ** 2 + a[1] ** 2;
  if (!b) return square < 16 ? null : [(x * a[0] + y * a[1]) / square];
  const area = a[0] * b[1] - a[1] * b[0];
  return Math.abs(area) < 16 ? null : [(x * b[1] - y * b[0]) / area, (a[0] * y - a[1] * x) / area];
}

/** @param {[number, number]} start @param {[number, number]} way */
function arrow([x, y], [dx, dy]) {
  const size = Math.hypot(dx, dy) || 1, [s, t] = [(14 * dx) / size, (14 * dy) / size], [endX, endY] = [x + dx, y + dy];
  return `M${x} ${y}L${endX} ${endY}L${endX - s - t / 2} ${endY - t + s / 2}L${endX - s + t / 2} ${endY - t - s / 2}L${endX} ${endY}`;
}

/** @param {[number, number]} at */
const disc = ([x, y]) => `M${x - 8} ${y}a8 8 0 1 0 16 0a8 8 0 1 0 -16 0`;
