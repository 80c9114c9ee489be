// The page's end of the worker that traces rays. The worker runs the page's own script.

import "./ray.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./ray.js").ImagePart} ImagePart */
/** @typedef {import("./ray.js").ImageRequest} ImageRequest */

/** A worker with one scene. The worker runs the page's own script: see the end of ray.js. */
export class RayClient {
  /** @param {Scene} scene @param {(part: ImagePart) => void} onImage takes parts of the newest image */
  constructor(scene, onImage) {
    const text = document.getElementById("lucida-code")?.textContent ?? "";
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    this.worker = new Worker(url);
    URL.revokeObjectURL(url);
    this.number = 0;
    /** @type {Map<number, (answer: any) => void>} */
    this.waiting = new Map();
    this.worker.onmessage = ({ data }) => {
      const resolve = this.waiting.get(data.number);
      if (resolve) {
        this.waiting.delete(data.number);
        resolve(data);
      } else if (data.number === this.newest) onImage(data);
    };
    this.newest = 0;
    this.worker.postMessage({ scene });
  }

  /** Ask for an image that is shown as it becomes finer; an older one is dropped. @param {Omit<ImageRequest, "number" | "whole">} request */
  follow(request) {
    this.newest = this.number += 1;
    this.worker.postMessage({ ...request, number: this.newest, whole: false });
  }

  /** Return the finished image. @param {Omit<ImageRequest, "number" | "whole">} request @returns {Promise<ImageData>} */
  async image(request) {
    const part = await this.ask({ ...request, whole: true });
    return new ImageData(part.bytes, part.width, part.height);
  }

  /** Return what a pixel's ray hits. @param {Omit<ImageRequest, "number" | "whole"> & {pixel: [number, number]}} request @returns {Promise<{t: number, object: number, point: Vec, normal: Vec, color: Vec}>} */
  probe(request) {
    return this.ask(request);
  }

  /** @param {object} request @returns {Promise<any>} */
  ask(request) {
    const number = (this.number += 1);
    return new Promise((resolve) => {
      this.waiting.set(number, resolve);
      this.worker.postMessage({ ...request, number });
    });
  }

  dispose() {
    this.worker.terminate();
  }
}
