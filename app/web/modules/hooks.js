// window.lucida: what tests and teachers can do with a figure.

import { cameraForSize, viewingRay } from "./camera.js";

/** Return the functions. @param {import("./figure.js").LiveFigure} live */
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
