// The page's end of the workers that trace rays: what they are asked for, and how their rows become
// images: coarse first, full after.

import "./ray_worker.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./ray.js").ImageRequest} ImageRequest */
/** @typedef {{width: number, height: number, bytes: Uint8ClampedArray, factor: number}} RayImage factor: pixels a side that one colour stands for */
/** @typedef {RayImage & {number: number, missing: number, ms: number, whenDone: () => void}} Job an image on its way; missing: how many workers' rows */

const MOST_WORKERS = 8;
const FIRST_IMAGE_MS = 30; // how long a coarse image may take
const COARSEST = 16;

/** Workers with one scene, which trace an image's rows together. */
export class RayClient {
  /**
   * @param {Scene} scene @param {(image: RayImage) => void} onImage takes the newest image as it becomes finer
   * @param {number} [most] workers
   */
  constructor(scene, onImage, most = MOST_WORKERS) {
    // The workers run the page's own script: see the end of ray_worker.js.
    const text = document.getElementById("lucida-code")?.textContent ?? "";
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    const count = Math.min(most, navigator.hardwareConcurrency || 1);
    this.workers = Array.from({ length: count }, () => new Worker(url));
    URL.revokeObjectURL(url);
    for (const worker of this.workers) worker.onmessage = ({ data }) => this.receive(data);
    this.workers[0].postMessage({ scene, isShared: true });
    this.onImage = onImage;
    this.number = 0;
    this.pixelsPerMs = 50;
    /** @type {Map<number, Job>} */
    this.jobs = new Map();
    /** @type {Map<number, (answer: any) => void>} */
    this.probes = new Map();
    /** @type {Job | null} */
    this.shown = null;
    /** @type {ImageRequest | null} */
    this.wanted = null;
    this.isFirst = false;
  }

  /** Let the next images show a scene. @param {Scene} scene */
  load(scene) {
    for (const worker of this.workers) worker.postMessage({ scene });
  }

  /**
   * Ask for an image that is shown as it becomes finer. It takes an older one's place, whose coarse
   * image is finished first: images follow one another then while the camera moves.
   * @param {ImageRequest} image
   */
  follow(image) {
    this.wanted = image;
    if (!this.shown || !this.isFirst) this.showCoarse();
  }

  showCoarse() {
    const image = /** @type {ImageRequest} */ (this.wanted), [width, height] = image.size;
    let factor = 1;
    while (factor < COARSEST && (width * height) / factor ** 2 > this.pixelsPerMs * FIRST_IMAGE_MS) factor *= 2;
    this.wanted = null;
    this.show(image, factor, true);
  }

  /** @param {ImageRequest} image @param {number} factor @param {boolean} isFirst */
  show(image, factor, isFirst) {
    if (this.shown) this.jobs.delete(this.shown.number);
    this.isFirst = isFirst;
    const job = this.start(image, factor, false, () => {
      this.shown = null;
      this.pixelsPerMs = (job.width * job.height) / Math.max(job.ms, 0.1);
      this.onImage(job);
      if (this.wanted) this.showCoarse();
      else if (factor > 1) this.show(image, factor > 4 ? factor / 4 : 1, false);
    });
    this.shown = job;
  }

  /** Return the finished image. @param {ImageRequest} image @returns {Promise<ImageData>} */
  image(image) {
    return new Promise((resolve) => {
      const job = this.start(image, 1, true, () => resolve(new ImageData(/** @type {any} */ (job.bytes), job.width, job.height)));
    });
  }

  /** @param {ImageRequest} image @param {number} factor @param {boolean} isWhole @param {() => void} whenDone @returns {Job} */
  start(image, factor, isWhole, whenDone) {
    const number = (this.number += 1), step = this.workers.length;
    const [width, height] = image.size.map((side) => Math.ceil(side / factor));
    const job = { number, factor, width, height, bytes: new Uint8ClampedArray(4 * width * height), missing: step, ms: 0, whenDone };
    this.jobs.set(number, job);
    this.workers.forEach((worker, first) => worker.postMessage({ number, image, factor, first, step, isWhole }));
    return job;
  }

  /** Return what a pixel's ray hits. @param {ImageRequest} image @param {[number, number]} pixel @returns {Promise<{t: number, object: number, point: Vec, normal: Vec, color: Vec}>} */
  probe(image, pixel) {
    const number = (this.number += 1);
    this.workers[0].postMessage({ number, image, pixel });
    return new Promise((resolve) => this.probes.set(number, resolve));
  }

  /** @param {any} answer a worker's: the hierarchy, a probed pixel, or Rows */
  receive(answer) {
    if (answer.tree) return this.workers.slice(1).forEach((worker) => worker.postMessage(answer));
    const job = this.jobs.get(answer.number);
    if (job) this.addRows(job, answer);
    this.probes.get(answer.number)?.(answer);
    this.probes.delete(answer.number);
    return undefined;
  }

  /** @param {Job} job @param {import("./ray_worker.js").Rows} rows */
  addRows(job, { first, step, bytes, ms }) {
    const length = 4 * job.width;
    for (let at = 0, row = first; at < bytes.length; at += length, row += step) {
      job.bytes.set(bytes.subarray(at, at + length), row * length);
    }
    job.ms = Math.max(job.ms, ms);
    job.missing -= 1;
    if (job.missing) return;
    this.jobs.delete(job.number);
    job.whenDone();
  }

  dispose() {
    for (const worker of this.workers) worker.terminate();
  }
}
