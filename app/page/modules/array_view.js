// The array: the numbers around the marked pixel.

import { element } from "./elements.js";

const ROWS = 5, COLUMNS = 5;

/** Return a table, and a function that fills it from an image. @param {0 | 1} from what the first row and column are called */
export function arrayView(from) {
  const body = element("tbody"), head = element("tr");
  const table = element("table", { class: "lucida-array" }, element("caption", {}, "The array around the pixel: red, green, blue, 0 to 255"), element("thead", {}, head), body);
  return {
    view: table,
    /** @param {HTMLCanvasElement} canvas of the ray image @param {[number, number]} pixel */
    show(canvas, [row, column]) {
      const { width, height } = canvas, context = canvas.getContext("2d", { willReadFrequently: true });
      const top = Math.max(0, Math.min(row - 2, height - ROWS)), left = Math.max(0, Math.min(column - 2, width - COLUMNS));
      const image = context?.getImageData(left, top, COLUMNS, ROWS);
      if (!image) return;
      head.replaceChildren(element("th", { scope: "col" }, "i \\ j"), ...Array.from({ length: COLUMNS }, (_, j) => element("th", { scope: "col" }, String(left + j + from))));
      body.replaceChildren(...Array.from({ length: ROWS }, (_, i) => element("tr", {}, element("th", { scope: "row" }, String(top + i + from)),
        ...Array.from({ length: COLUMNS }, (__, j) => {
          const at = 4 * (i * COLUMNS + j), isMarked = top + i === row && left + j === column;
          return element("td", isMarked ? { "aria-current": "true" } : {}, Array.from(image.data.subarray(at, at + 3)).join(" "));
        }))));
    },
  };
}
