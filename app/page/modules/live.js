// The live figures of a lecture: one at a time, that of the step which is shown.

import { element } from "./elements.js";
import { figure } from "./figure.js";
import { hooks } from "./hooks.js";

/** @typedef {import("./figure.js").LiveFigure} LiveFigure */
/** @typedef {Parameters<typeof figure>[1]} Content */
/** @typedef {Omit<Content, "scene"> & {scene: number}} StepFigure */

const NEED_WEBGL = ["raster", "wipe", "difference", "outside"];

export class LiveFigures {
  /** @param {{figures: Record<string, StepFigure>, scenes: any[], shaders: any[]}} data */
  constructor({ figures, scenes, shaders }) {
    this.figures = figures;
    this.scenes = scenes.map((scene) => ({ ...scene, shaders: shaders[scene.shaders] }));
    this.hasWebGl = document.createElement("canvas").getContext("webgl2") !== null;
    /** @type {LiveFigure | null} */
    this.live = null;
    /** @type {HTMLElement | null} */
    this.place = null;
  }

  /** Show a step's figure instead of its stills, and end the last one's. @param {Element} step */
  show(step) {
    const place = /** @type {HTMLElement | null} */ (step.querySelector(".live-figure"));
    const folded = place?.closest("details");
    if (folded) folded.ontoggle = () => folded.open && this.show(step);
    if (place === this.place) return;
    this.live?.dispose();
    if (this.place) this.place.hidden = true;
    this.live = null;
    this.place = place;
    const shown = this.figures[place?.dataset.step ?? ""];
    const needsWebGl = shown?.shows.some((name) => NEED_WEBGL.includes(name));
    const scene = this.scenes[shown?.scene];
    if (folded && !folded.open) this.place = null;
    if (!this.place || !place || !scene || (needsWebGl && !this.hasWebGl)) return;
    place.hidden = false;
    this.live = figure(place, { ...shown, scene });
    this.live.ready.then(() => fold(place));
    Object.assign(window, { lucida: hooks(this.live) });
  }
}

/** Put a figure's controls under a heading that opens them. @param {HTMLElement} place */
function fold(place) {
  const controls = place.querySelector(".lucida-controls");
  if (!controls) return;
  const folded = element("details", {}, element("summary", {}, "Camera"));
  controls.replaceWith(folded);
  folded.append(controls);
}
