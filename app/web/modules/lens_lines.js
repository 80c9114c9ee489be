// The way through a lens from a pixel's point to its direction, line by line: the same symbols as
// app/instruments/probe/lens_formulas.py. (a', b') is the point on the image plane at distance 1, downwards;
// (a, b), in a fisheye (U, V), is where it would be without distortion; (X, Y, Z) is the direction.

import { numberText, vectorText } from "./elements.js";
import { lensOf } from "./lens.js";

/** @typedef {import("./lens.js").LensFields} LensFields */
/** @typedef {[string, string, string]} LensLine a name, the id of a formula, the numbers */
/** @typedef {[number, string]} Term a coefficient and what it multiplies */

const POWERS = ["\u00b2", "\u2074", "\u2076", "\u2078"];
const TANGENTIAL = ["p1", "p2", "s1", "s2", "s3", "s4", "sx1", "sy1"];

/** Return the lines of a point of the image plane. @param {LensFields} lens @param {number} x @param {number} y in units of d */
export function lensLines(lens, x, y) {
  const direction = lensOf(lens).direction(x, -y), [a, b, c] = direction;
  /** @type {LensLine[]} */
  const lines = [["on the image plane at distance 1, downwards", "lens-plane", `= ${vectorText([x, -y])}`]];
  const { model, ...coefficients } = lens, isBrown = model === "brown";
  const isDistorted = model !== "fov" && Object.values(coefficients).some((value) => value !== 0);
  if (isDistorted) {
    lines.push(...distortionLines(lens, isBrown));
    const scale = isBrown ? 1 : Math.atan2(Math.hypot(a, b), c) / (Math.hypot(a, b) || 1);
    lines.push(["undone by Newton\u2019s method", "", `${isBrown ? "(a, b)" : "(U, V)"} = ${vectorText([scale * a, scale * b])}`]);
  }
  const isIdeal = !isDistorted && ["fisheye", "thin_prism_fisheye"].includes(model);
  lines.push(["direction in the camera, forwards", `lens-${isIdeal ? "equidistant" : model}`, `= ${vectorText(direction)}`]);
  return lines;
}

/** Return what the lens does to a radius or a point, without terms that are 0. @param {LensFields} lens @param {boolean} isBrown @returns {LensLine[]} */
function distortionLines(lens, isBrown) {
  /** @param {string} name */
  const value = (name) => Number(lens[name] ?? 0);
  const isRadial = TANGENTIAL.every((name) => value(name) === 0);
  const r = isBrown ? "r" : isRadial ? "\u03b8" : "R";
  /** @param {string[]} names */
  const polynomial = (names) => sum("1", names.map((name, k) => [value(name), `${r}${POWERS[k]}`]));
  const above = polynomial(["k1", "k2", "k3", isBrown ? "r8" : "k4"]), below = isBrown ? polynomial(["k4", "k5", "k6"]) : "1";
  const factor = below === "1" ? `(${above})` : `(${above}) / (${below})`;
  if (isRadial) return [[`distortion, ${r}\u2032 = |(a\u2032, b\u2032)|`, "", `${r}\u2032 = ${r} ${factor}`]];
  const [p, q] = isBrown ? ["a", "b"] : ["U", "V"], prism = isBrown ? [["s1", "s2"], ["s3", "s4"]] : [["sx1"], ["sy1"]];
  /** @param {string} axis @param {number} k @returns {LensLine} */
  const line = (axis, k) => [`distortion, ${r}\u00b2 = ${p}\u00b2 + ${q}\u00b2`, "", `${"ab"[k]}\u2032 = ${sum(`${axis} ${factor}`, [
    [2 * value(["p1", "p2"][k]), `${p} ${q}`],
    [value(["p2", "p1"][k]), `(${r}\u00b2 + 2 ${axis}\u00b2)`],
    ...prism[k].map((name, n) => /** @type {Term} */ ([value(name), `${r}${POWERS[n]}`])),
  ])}`];
  return [line(p, 0), line(q, 1)];
}

/** Return a sum as text, without terms that are 0. @param {string} first @param {Term[]} terms */
const sum = (first, terms) => terms.reduce((text, [value, what]) =>
  (value ? `${text} ${value > 0 ? "+" : "\u2212"} ${numberText(Math.abs(value))} ${what}` : text), first);
