// A page of one scene: what `lucida page` writes.

import { cameraForSize, viewingRay } from "./camera.js";
import { figure } from "./figure.js";

/** Start the page. */
export function start() {
  const data = JSON.parse(document.getElementById("lucida-data")?.textContent ?? "");
  const parent = /** @type {HTMLElement} */ (document.getElementById("lucida-figure"));
  const live = figure(parent, { scene: data.scene, camera: data.camera, shows: data.shows });
  Object.assign(window, { lucida: hooks(live) });
}

/** Return what tests and teachers can do: window.lucida. @param {import("./figure.js").LiveFigure} live */
export function hooks(live) {
  return {
    get camera() {
      return live.camera;
    },
    /** @param {Partial<import("./camera.js").Camera>} camera */
    set: (camera) => live.set(camera),
    /** @param {number} i @param {number} j @param {import("./camera.js").Size} size */
    ray: (i, j, size) => viewingRay(cameraForSize(live.camera, size), i, j, size),
    /** @param {"ray" | "raster"} kind @param {import("./camera.js").Size} size */
    pixels: (kind, size) => live.pixels(kind, size),
    ready: live.ready,
  };
}
