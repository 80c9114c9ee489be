// One image with its caption: a canvas that is turned, moved and zoomed by pointer, touch and keys.

import { element } from "./elements.js";

/**
 * What a view asks of its figure. x, y: parts of the image's width and height.
 * @typedef {object} ViewActions
 * @property {(x: number, y: number) => void} orbit
 * @property {(x: number, y: number) => void} pan
 * @property {(factor: number) => void} zoom
 * @property {(x: number, y: number) => void} mark a place from 0 to 1
 * @property {(rows: number, columns: number) => void} step from the marked pixel
 */

const KEY_STEP = 0.02;
const CLICK = 4; // CSS pixels: less is no drag

/** Return a figure of a canvas and a caption. @param {string} title @returns {{view: HTMLElement, canvas: HTMLCanvasElement}} */
export function imageView(title) {
  const canvas = element("canvas", { tabindex: "0", role: "img", "aria-label": title });
  const stage = element("div", { class: "lucida-stage" }, canvas, element("span", { class: "lucida-mark" }));
  return { view: element("figure", { class: "lucida-image" }, stage, element("figcaption", {}, title)), canvas };
}

/** Draw a coarse or full image on a canvas. @param {HTMLCanvasElement} canvas @param {[number, number]} size the full image's @param {import("./ray_client.js").RayImage} image */
export function drawEnlarged(canvas, [w, h], { width, height, factor, bytes }) {
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const small = element("canvas", { width: String(width), height: String(height) });
  small.getContext("2d")?.putImageData(new ImageData(/** @type {any} */ (bytes), width, height), 0, 0);
  context.imageSmoothingEnabled = false;
  context.drawImage(small, 0, 0, width * factor, height * factor);
}

/** Let pointers, touch and keys move the camera. @param {HTMLElement} view @param {ViewActions} actions */
export function addNavigation(view, actions) {
  /** @type {Map<number, {x: number, y: number}>} */
  const pointers = new Map();
  let moved = 0, isPanning = false;
  /** Return the mean place of the pointers, and how far they are apart. */
  const grip = () => {
    const all = [...pointers.values()];
    const x = all.reduce((sum, p) => sum + p.x, 0) / all.length, y = all.reduce((sum, p) => sum + p.y, 0) / all.length;
    return { x, y, apart: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0 };
  };
  view.addEventListener("pointerdown", (event) => {
    view.setPointerCapture(event.pointerId);
    view.focus({ preventScroll: true });
    if (!pointers.size) moved = 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    isPanning = event.shiftKey || event.button > 0;
  });
  view.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return;
    const before = grip(), { clientWidth, clientHeight } = view;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = grip(), x = (after.x - before.x) / clientWidth, y = (after.y - before.y) / clientHeight;
    moved += Math.abs(after.x - before.x) + Math.abs(after.y - before.y);
    if (moved < CLICK && pointers.size === 1) return;
    if (pointers.size > 1) {
      actions.pan(x, y);
      if (before.apart && after.apart) actions.zoom(before.apart / after.apart);
    } else if (isPanning) actions.pan(x, y);
    else actions.orbit(x, y);
  });
  /** @param {PointerEvent} event */
  const release = (event) => {
    if (!pointers.delete(event.pointerId) || pointers.size || moved >= CLICK || event.type !== "pointerup") return;
    const box = view.getBoundingClientRect();
    actions.mark((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  };
  view.addEventListener("pointerup", release);
  view.addEventListener("pointercancel", release);
  view.addEventListener("contextmenu", (event) => event.preventDefault());
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    actions.zoom(Math.exp(0.001 * event.deltaY));
  }, { passive: false });
  view.addEventListener("keydown", (event) => {
    const [right, down] = /** @type {[number, number]} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key] ?? [0, 0]);
    if (right || down) {
      if (event.altKey) actions.step(down, right);
      else if (event.shiftKey) actions.pan(-KEY_STEP * right, -KEY_STEP * down);
      else actions.orbit(-KEY_STEP * right, -KEY_STEP * down);
    } else if (event.key === "+" || event.key === "=") actions.zoom(1 / 1.1);
    else if (event.key === "-") actions.zoom(1.1);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
}
