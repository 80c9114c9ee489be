// A wrong answer beside the correct one, drawn with the camera: rays, vectors and points.

import { svgElement } from "./elements.js";

/** @typedef {number[]} Point of the world, or on paper */
/**
 * How the world lies on paper.
 * @typedef {object} Paper
 * @property {Point} eye @property {Point[]} basis u, v, w @property {number[][]} onto (3, 2)
 * @property {Point[]} corners of the viewport @property {boolean} parallel
 * @property {number} reach how far a ray is drawn
 */
/**
 * An arrow from a point to another one, or a point alone.
 * @typedef {{from: Point, to?: Point, kind: "right" | "given", label: string}} Mark
 */


const DRAWING_PX = 320, EDGE_PX = 36, HEAD_PX = 11;

/** @param {Point} a @param {Point} b @param {number} [s] @returns {Point} a + s b */
export const moved = (a, b, s = 1) => a.map((x, k) => x + s * b[k]);

/** Return the marks of a ray. @param {Paper} paper @param {"right" | "given"} kind
 * @param {Point} origin @param {Point} direction @param {string} label @returns {Mark} */
export function rayMark(paper, kind, origin, direction, label) {
  const length = Math.hypot(...direction);
  const to = length > 0 ? moved(origin, direction, paper.reach / length) : undefined;
  return { from: origin, to, kind, label };
}

/** Return the mark of a vector. @param {Paper} paper @param {"right" | "given"} kind
 * @param {Point} value @param {"arrow" | "point" | "corner"} draw @param {string} label
 * @returns {Mark} */
export function vectorMark(paper, kind, value, draw, label) {
  if (draw === "arrow") return { from: paper.eye, to: moved(paper.eye, value), kind, label };
  if (draw === "point") return { from: value, kind, label };
  const [u, v, w] = paper.basis;
  const plane = moved(moved(moved(paper.eye, u, value[0]), v, value[1]), w, -value[2]);
  return { from: plane, kind, label };
}

/**
 * Return a drawing. What is correct has full lines, what was given dashed ones.
 * @param {Paper} paper @param {Mark[]} marks
 * @param {string} name for those who cannot see it
 */
export function drawing(paper, marks, name) {
  const all = [paper.eye, ...paper.corners, ...marks.flatMap(({ from, to }) => [from, to ?? from])];
  const flat = all.map((point) => onPaper(paper, point));
  const [left, top] = [0, 1].map((k) => Math.min(...flat.map((p) => p[k])));
  const [right, bottom] = [0, 1].map((k) => Math.max(...flat.map((p) => p[k])));
  const scale = DRAWING_PX / Math.max(right - left, bottom - top, 1e-9);
  /** @param {Point} point */
  const at = (point) => {
    const [x, y] = onPaper(paper, point);
    return [(x - left) * scale + EDGE_PX, (y - top) * scale + EDGE_PX];
  };
  const [width, height] = [right - left, bottom - top].map((side) => side * scale + 2 * EDGE_PX);
  const svg = svgElement("svg", { class: "sketch", viewBox: `0 0 ${width} ${height}`, role: "img" });
  svg.setAttribute("aria-label", name);
  const frame = paper.corners.map(at);
  if (frame.length) svg.append(pathThrough([...frame, frame[0]], "viewport"));
  const eye = at(paper.eye);
  if (!paper.parallel) svg.append(...frame.map((corner) => pathThrough([eye, corner], "edge")));
  svg.append(dotAt(eye, "eye"), labelAt([eye[0], eye[1] + 20], "eye", "plain"));
  for (const { from, to, kind, label } of marks) {
    const [start, end] = [at(from), at(to ?? from)];
    const [dx, dy] = [end[0] - start[0], end[1] - start[1]];
    const length = Math.hypot(dx, dy);
    if (length < 1) svg.append(dotAt(start, kind));
    else svg.append(pathThrough([start, end], kind), arrowHead(end, dx / length, dy / length, kind));
    const away = length < 1 ? [0, 1] : [dx / length, dy / length];
    svg.append(labelAt([end[0] + 14 * away[0], end[1] + 14 * away[1] + 5], label, kind));
  }
  return svg;
}

/** @param {Paper} paper @param {Point} point @returns {Point} */
function onPaper(paper, point) {
  const offset = moved(point, paper.eye, -1);
  return [0, 1].map((k) => offset.reduce((sum, x, axis) => sum + x * paper.onto[axis][k], 0));
}

/** @param {Point[]} points @param {string} kind */
const pathThrough = (points, kind) =>
  svgElement("path", { class: kind, d: `M${points.map(([x, y]) => `${x} ${y}`).join("L")}` });

/** @param {Point} at @param {string} kind */
const dotAt = ([x, y], kind) => svgElement("circle", { class: kind, cx: `${x}`, cy: `${y}`, r: "5" });

/** @param {Point} end @param {number} x @param {number} y @param {string} kind */
function arrowHead(end, x, y, kind) {
  const back = [end[0] - HEAD_PX * x, end[1] - HEAD_PX * y];
  const side = [-y * HEAD_PX * 0.45, x * HEAD_PX * 0.45];
  return pathThrough([end, moved(back, side), moved(back, side, -1), end], `${kind} head`);
}

/** @param {Point} at @param {string} content @param {string} kind */
function labelAt([x, y], content, kind) {
  const element = svgElement("text", { class: kind, x: `${x}`, y: `${y}`, "text-anchor": "middle" });
  element.textContent = content;
  return element;
}
