// The live figures of a lecture: one at a time, that of the step which is shown.

import { element } from "./elements.js";
import { figure } from "./figure.js";
import { hooks } from "./hooks.js";

/** @typedef {import("./figure.js").LiveFigure} LiveFigure */
/** @typedef {Parameters<typeof figure>[1]} Content */
/** @typedef {Omit<Content, "scene"> & {scene: number, photograph: {src: string, opacity: number} | null}} StepFigure */

// What is shown without WebGL.
const INSTEAD = /** @type {Record<string, Content["shows"]>} */ ({ raster: ["ray"], wipe: [], difference: [] });

export class LiveFigures {
  /** @param {{figures: Record<string, StepFigure>, scenes: any[], shaders: any[]}} data */
  constructor({ figures, scenes, shaders }) {
    this.figures = figures;
    this.scenes = scenes.map((scene) => ({ ...scene, shaders: shaders[scene.shaders] }));
    this.hasWebGl = document.createElement("canvas").getContext("webgl2") !== null;
    document.body.classList.toggle("no-webgl", !this.hasWebGl);
    /** @type {LiveFigure | null} */
    this.live = null;
    /** @type {HTMLElement | null} */
    this.place = null;
  }

  /**
   * Show a step's figure instead of its stills, and end the last one's. Without WebGL, show what
   * needs none, and the stills too.
   * @param {Element} step
   */
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
    const shows = [...new Set(shown?.shows.flatMap((name) => (!this.hasWebGl && INSTEAD[name]) || [name]))];
    const scene = this.scenes[shown?.scene];
    if (folded && !folded.open) this.place = null;
    if (!this.place || !place || !scene || !shows.length) return;
    place.hidden = false;
    /** @type {Content["options"]} */
    const options = { ...structuredClone(shown.options), onShift: (moved, where) =>
      place.dispatchEvent(new CustomEvent("shifted", { bubbles: true, detail: { scene: moved, place: where } })) };
    this.live = figure(place, { ...shown, shows, scene, options });
    this.live.ready.then(() => shown.photograph && lay(place, shown.photograph));
    Object.assign(window, { lucida: hooks(this.live) });
  }
}

/** Lay a photograph over a figure's image. @param {HTMLElement} place @param {{src: string, opacity: number}} photograph */
function lay(place, { src, opacity }) {
  const picture = element("img", { src, alt: "The photograph, laid over the image", class: "lucida-photograph" });
  picture.style.opacity = String(opacity);
  place.querySelector(".lucida-images .lucida-stage")?.append(picture);
}
