// The probe: the viewing ray of the marked pixel, as a formula and with its numbers.

import { imagePoint, isParallel, viewingRay } from "./camera.js";
import { element, numberText, vectorText } from "./elements.js";
import { lensLines } from "./lens_lines.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {{name: string, formula: string, key: string}} ProbeLine formula: the id of a template */
/** @typedef {{t: number, name: string, point: Vec, normal: Vec, color: Vec}} ProbedHit t is Infinity for none; color: bytes */

/**
 * The probe's lines in words, and the templates of their formulas: app/web/formulas.py.
 * @type {[string, string, (values: ProbeValues) => string | null][]}
 */
const LINES = [
  ["along u", "u", ({ x, camera, size, pixel, from }) => {
    const [left, right] = camera.viewport;
    return `= ${signed(left)} + (${numberText(right)} \u2212 ${signed(left)}) (${centre(pixel[1], from)}) / ${size[0]} = ${numberText(x)}`;
  }],
  ["along v", "v", ({ y, camera, size, pixel, from }) => {
    const [, , bottom, top] = camera.viewport;
    return `= ${numberText(top)} \u2212 (${numberText(top)} \u2212 ${signed(bottom)}) (${centre(pixel[0], from)}) / ${size[1]} = ${numberText(y)}`;
  }],
  ["direction", "direction", ({ x, y, camera, direction }) => {
    if (isParallel(camera)) return `= ${vectorText(direction)}`;
    if (camera.lens) return `= ${vectorText(direction)}`;
    const { u, v, w, distance } = camera;
    return `= ${signed(x)} ${vectorText(u)} + ${signed(y)} ${vectorText(v)} \u2212 ${numberText(distance)} ${vectorText(w)} = ${vectorText(direction)}`;
  }],
  ["origin", "origin", ({ origin }) => `= ${vectorText(origin)}`],
  ["ray", "ray", ({ origin, direction }) => `= ${vectorText(origin)} + t ${vectorText(direction)}`],
  ["hit", "point", ({ hit }) => {
    if (!hit) return "\u2026";
    return Number.isFinite(hit.t) ? `= ${vectorText(hit.point)} at t = ${numberText(hit.t)}${hit.name ? `, on ${hit.name}` : ""}` : "nothing is hit";
  }],
  ["normal", "normal", ({ hit }) => (hit && Number.isFinite(hit.t) ? `= ${vectorText(hit.normal)}` : null)],
];

/** @typedef {{camera: Camera, size: Size, pixel: [number, number], x: number, y: number, origin: Vec, direction: Vec, hit: ProbedHit | null, from: 0 | 1}} ProbeValues from: the first row and column */

/** Return a pixel's centre, as a sum. @param {number} index from 0 @param {0 | 1} from */
const centre = (index, from) => `${index + from} ${from ? "\u2212" : "+"} 0.5`;

/** Return a number, in parentheses if it is negative. @param {number} x */
const signed = (x) => (x < 0 ? `(${numberText(x)})` : numberText(x));

/**
 * Return the probe, and a function that shows a pixel in it.
 * @param {(rows: number, columns: number) => void} step moves the mark
 * @param {0 | 1} from what the first row and column are called
 */
export function probeView(step, from) {
  const title = element("p", { class: "lucida-pixel", role: "status" }), swatch = element("span", { class: "lucida-swatch" });
  const list = element("dl", { class: "lucida-lines" });
  const buttons = /** @type {[string, string, number, number][]} */ ([
    ["\u2190", "Previous column", 0, -1], ["\u2192", "Next column", 0, 1], ["\u2191", "Previous row", -1, 0], ["\u2193", "Next row", 1, 0],
  ]).map(([sign, spoken, rows, columns]) => {
    const button = element("button", { type: "button", "aria-label": spoken, title: spoken }, sign);
    button.addEventListener("click", () => step(rows, columns));
    return button;
  });
  const view = element("section", { class: "lucida-probe", "aria-label": "Probe" },
    element("h2", {}, "A pixel\u2019s ray"), element("div", { class: "lucida-steps" }, ...buttons, title, swatch), list);
  return {
    view,
    /** @param {Camera} camera fitted @param {Size} size @param {[number, number]} pixel @param {ProbedHit | null} hit null while it is not known */
    show(camera, size, pixel, hit) {
      const [x, y] = imagePoint(camera, ...pixel, size), { origin, direction } = viewingRay(camera, ...pixel, size);
      title.textContent = `row ${pixel[0] + from}, column ${pixel[1] + from} of ${size[0]} x ${size[1]}, from ${from}`;
      if (hit) swatch.style.background = `rgb(${hit.color.join(" ")})`;
      const values = { camera, size, pixel, x, y, origin, direction, hit, from };
      if (Number.isNaN(direction[0])) return list.replaceChildren(element("dd", {}, "The lens sees nothing here."));
      const kind = isParallel(camera) ? "parallel" : camera.lens ? "lens" : "perspective";
      const lines = LINES.map(([name, key, text]) => /** @type {const} */ ([name, key, text(values)]));
      if (camera.lens) lines.splice(2, 0, ...lensLines(camera.lens, x / camera.distance, y / camera.distance));
      list.replaceChildren(...lines.flatMap(([name, key, numbers]) => {
        return numbers === null ? [] : [element("dt", {}, name), element("dd", {}, ...formulaOf(`${key}-${kind}`, key), " ", element("span", { class: "lucida-numbers" }, numbers))];
      }));
      return undefined;
    },
  };
}

/** Return a copy of a formula that the page holds; none if it does not. @param {string[]} ids the first one that there is */
function formulaOf(...ids) {
  for (const id of ids) {
    const template = document.getElementById(`formula-${id}`);
    if (template instanceof HTMLTemplateElement) return [document.importNode(template.content, true)];
  }
  return [];
}
