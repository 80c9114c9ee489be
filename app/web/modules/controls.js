// Sliders for the camera: its eye, basis, distance, viewport, projection and lens.

import { element, numberText } from "./elements.js";
import { length, minus, plus, times } from "./vectors.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./ray.js").Effects} Effects */
/** @typedef {"eye" | "u" | "v" | "w" | "viewport"} ListField */

const VECTORS = /** @type {[ListField, string, string[]][]} */ ([
  ["eye", "Eye e", ["x", "y", "z"]],
  ["u", "Right u", ["x", "y", "z"]],
  ["v", "Up v", ["x", "y", "z"]],
  ["w", "Back w", ["x", "y", "z"]],
  ["viewport", "Viewport", ["left", "right", "bottom", "top"]],
]);

/** Return a slider and a field for one number. @param {string} name @param {string} spoken @param {(x: number) => void} onInput */
function numberRow(name, spoken, onInput) {
  const range = element("input", { type: "range", step: "any", "aria-label": spoken });
  const field = element("input", { type: "number", step: "any", "aria-label": `${spoken}, number` });
  range.addEventListener("input", () => onInput(range.valueAsNumber));
  field.addEventListener("change", () => {
    if (Number.isFinite(field.valueAsNumber)) onInput(field.valueAsNumber);
  });
  return {
    row: element("div", { class: "lucida-number" }, element("span", { "aria-hidden": "true" }, name), range, field),
    /** @param {number} value @param {number} low @param {number} high */
    show(value, low, high) {
      range.min = String(Math.min(low, value));
      range.max = String(Math.max(high, value));
      range.value = String(value);
      range.setAttribute("aria-valuetext", numberText(value));
      if (document.activeElement !== field) field.value = String(Number(value.toPrecision(5)));
    },
  };
}

/**
 * Return the camera's controls, and a function that shows a camera in them.
 * @param {Camera} first @param {import("./scene.js").Scene} scene
 * @param {(change: (camera: Camera) => Partial<Camera>) => void} onChange
 * @param {Effects} effects changed by the controls @param {() => void} onEffects
 */
export function cameraControls(first, scene, onChange, effects, onEffects) {
  const low = /** @type {any} */ (Array.from(scene.focus.subarray(0, 3))), high = /** @type {any} */ (Array.from(scene.focus.subarray(3, 6)));
  const middle = times(0.5, plus(low, high));
  const reach = 2 * Math.max(length(minus(high, low)), length(minus(first.eye, middle)));
  /** @type {((camera: Camera) => void)[]} */
  const shown = [];
  /** @param {string} legend @param {HTMLElement[]} rows @returns {HTMLElement} */
  const group = (legend, ...rows) => element("fieldset", {}, element("legend", {}, legend), ...rows);

  const groups = VECTORS.map(([field, legend, names]) => group(legend, ...names.map((name, k) => {
    const row = numberRow(name, `${legend}, ${name}`, (x) => onChange((camera) => {
      const values = /** @type {number[]} */ ([...camera[field]]);
      values[k] = x;
      return { [field]: values, ...(field === "viewport" ? { fit: false } : {}) };
    }));
    const widest = field === "viewport" ? 3 * Math.max(...first.viewport.map(Math.abs)) : 2 * length(/** @type {any} */ (first[field]));
    shown.push((camera) => {
      const at = field === "eye" ? middle[k] : 0, far = field === "eye" ? reach : widest;
      row.show(camera[field][k], at - far, at + far);
    });
    return row.row;
  })));

  const distance = numberRow("d", "Distance d", (x) => onChange(() => ({ distance: x })));
  shown.push((camera) => distance.show(camera.distance, first.distance / 10, first.distance * 5));
  const projections = /** @type {const} */ (["perspective", "parallel"]).map((name) => {
    const choice = element("input", { type: "radio", name: `projection-${projectionGroups}`, value: name });
    choice.addEventListener("change", () => onChange(() => ({ projection: name, ...(name === "parallel" ? { lens: undefined } : {}) })));
    shown.push((camera) => (choice.checked = camera.projection === name));
    return element("label", {}, choice, ` ${name}`);
  });
  projectionGroups += 1;
  groups.push(group("Distance d", distance.row), group("Projection", ...projections));
  if (first.lens) groups.push(lensGroup(first, group, shown, onChange));
  groups.push(group("Image", ...effectControls(effects, onEffects)));
  return {
    view: element("div", { class: "lucida-controls" }, ...groups),
    /** @param {Camera} camera */
    show: (camera) => shown.forEach((show) => show(camera)),
  };
}

let projectionGroups = 0;

/**
 * @param {Camera} first @param {(legend: string, ...rows: HTMLElement[]) => HTMLElement} group
 * @param {((camera: Camera) => void)[]} shown @param {(change: (camera: Camera) => Partial<Camera>) => void} onChange
 */
function lensGroup(first, group, shown, onChange) {
  const lens = /** @type {import("./lens.js").LensFields} */ (first.lens), { model, ...coefficients } = lens;
  const use = element("input", { type: "checkbox" });
  use.addEventListener("change", () => onChange(() => (use.checked ? { lens, projection: "perspective" } : { lens: undefined })));
  shown.push((camera) => (use.checked = camera.lens !== undefined));
  const rows = Object.keys(coefficients).map((name) => {
    const row = numberRow(name, `Lens, ${name}`, (x) => onChange((camera) => ({ lens: { .../** @type {any} */ (camera.lens ?? lens), [name]: x }, projection: "perspective" })));
    const widest = 2 * Math.max(Math.abs(Number(coefficients[name])), 0.05);
    shown.push((camera) => row.show(Number((camera.lens ?? lens)[name]), name === "omega" ? 0.1 : -widest, widest));
    return row.row;
  });
  return group(`Lens: ${model}`, element("label", {}, use, " use it"), ...rows);
}

/** @param {Effects} effects @param {() => void} onEffects */
function effectControls(effects, onEffects) {
  const exposure = numberRow("EV", "Exposure in stops", (x) => {
    effects.exposure = Math.min(Math.max(x, -32), 32);
    exposure.show(effects.exposure, -4, 4);
    onEffects();
  });
  exposure.show(effects.exposure, -4, 4);
  const shadows = element("input", { type: "checkbox" }), mirrors = element("input", { type: "checkbox" });
  shadows.checked = effects.shadows;
  mirrors.checked = effects.mirrors > 0;
  shadows.addEventListener("change", () => {
    effects.shadows = shadows.checked;
    onEffects();
  });
  mirrors.addEventListener("change", () => {
    effects.mirrors = mirrors.checked ? 2 : 0;
    onEffects();
  });
  return [exposure.row, element("label", {}, shadows, " shadows in the ray image"), element("label", {}, mirrors, " reflections in the ray image")];
}
