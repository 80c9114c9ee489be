// A worker that traces rays for the page. Several workers divide an image: of n, each traces every
// n-th row. The first one builds the hierarchy, and shares it.

import { buildTree } from "./hierarchy.js";
import { probed, traceRow } from "./ray.js";

/** @typedef {import("./hierarchy.js").Tree} Tree */
/**
 * @typedef {object} RowsRequest
 * @property {number} number
 * @property {import("./ray.js").ImageRequest} image
 * @property {number} factor pixels a side that one colour stands for
 * @property {number} first the first row
 * @property {number} step from a row to the next one
 * @property {boolean} isWhole whether it is answered though a newer one comes
 */
/** @typedef {{number: number, first: number, step: number, bytes: Uint8ClampedArray, ms: number}} Rows ms: how long they took */

const SLICE_MS = 15; // how long the worker computes before it looks for a newer request

/**
 * Answer a page's messages: {scene} or {tree}, then RowsRequests, or {number, image, pixel}.
 * @param {{postMessage: (message: any, transfer?: Transferable[]) => void, onmessage: any}} port
 */
export function serveRows(port) {
  /** @type {Tree | null} */
  let tree = null;
  /** @type {RowsRequest[]} */
  const waiting = [];
  let isBusy = false, newest = 0;
  // A task of its own, after the messages that wait. Timers are slower: they wait 4 ms.
  const channel = new MessageChannel();
  const nextTask = () => new Promise((resolve) => {
    channel.port1.onmessage = resolve;
    channel.port2.postMessage(null);
  });

  /** @param {RowsRequest} request */
  async function trace({ number, image, factor, first, step, isWhole }) {
    const [columns, rows] = image.size.map((side) => Math.ceil(side / factor));
    const count = Math.max(0, Math.ceil((rows - first) / step));
    const bytes = new Uint8ClampedArray(4 * columns * count);
    let since = performance.now(), ms = 0;
    for (let k = 0; k < count; k += 1) {
      if (!isWhole && number !== newest) return;
      traceRow(/** @type {Tree} */ (tree), image, factor, first + k * step, bytes.subarray(4 * columns * k, 4 * columns * (k + 1)));
      if (performance.now() - since < SLICE_MS) continue;
      ms += performance.now() - since;
      await nextTask();
      since = performance.now();
    }
    ms += performance.now() - since;
    port.postMessage({ number, first, step, bytes, ms }, [bytes.buffer]);
  }

  async function work() {
    if (isBusy || !tree) return;
    isBusy = true;
    for (let request = waiting.shift(); request; request = waiting.shift()) await trace(request);
    isBusy = false;
  }

  port.onmessage = (/** @type {MessageEvent} */ { data }) => {
    if (data.tree) tree = data.tree;
    else if (data.scene) {
      tree = buildTree(data.scene);
      if (data.isShared) port.postMessage({ tree });
    } else if (data.pixel) port.postMessage({ number: data.number, ...probed(/** @type {Tree} */ (tree), data.image, data.pixel) });
    else {
      waiting.push(data);
      if (!data.isWhole) newest = data.number;
    }
    work();
  };
}

// The page's own text is the worker's too: there, no document is.
if (typeof document === "undefined" && typeof postMessage === "function") serveRows(/** @type {any} */ (globalThis));
