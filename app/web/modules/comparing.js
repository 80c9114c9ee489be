// Both images in one place: a wipe between them, or their difference.

import { element } from "./elements.js";

const MODES = { side: "Side by side", wipe: "Wipe", difference: "Difference" };
const GAIN = 8; // of the difference, so that it is visible
const RESTS_MS = 300; // without a change, before whole images are made

/** @typedef {keyof typeof MODES} Mode */
/** @typedef {{kind: "raster" | "ray", view: HTMLElement, canvas: HTMLCanvasElement}} View */

/**
 * Return controls that show two views beside one another or in one place.
 * @param {HTMLElement} images the views' parent @param {View[]} views the raster image's and the ray image's
 * @param {Mode[]} modes @param {Mode} first the mode at first
 * @param {() => Promise<[ImageData, ImageData]>} both returns both finished images
 */
export function comparison(images, views, modes, first, both) {
  const result = element("p", { class: "lucida-result", role: "status" });
  const canvas = element("canvas", { role: "img", "aria-label": "Difference of both images" });
  const shown = element("figure", { class: "lucida-image", hidden: true }, canvas, element("figcaption", {}, `Difference, ${GAIN} times as bright`));
  const range = element("input", { type: "range", min: "0", max: "100", value: "50", "aria-label": "Where the wipe is, in percent from the left" });
  const wipe = element("label", { class: "lucida-wipe", hidden: true }, "raster image ", range, " ray image");
  const name = `mode-${(comparisons += 1)}`;
  let mode = first, timer = 0, asked = 0;
  const moveWipe = () => images.style.setProperty("--wipe", `${range.value}%`);
  range.addEventListener("input", moveWipe);
  moveWipe();

  /** @param {Mode} next */
  const choose = (next) => {
    mode = next;
    images.dataset.mode = mode;
    wipe.hidden = mode !== "wipe";
    shown.hidden = mode !== "difference";
    for (const { view } of views) view.hidden = mode === "difference";
    update();
  };
  const choices = modes.map((one) => {
    const choice = element("input", { type: "radio", name, value: one });
    choice.checked = one === mode;
    choice.addEventListener("change", () => choose(one));
    return element("label", {}, choice, ` ${MODES[one]}`);
  });
  images.append(shown);

  /** Compare the finished images when nothing has changed for a while, unless they are side by side. */
  const update = () => {
    clearTimeout(timer);
    asked += 1;
    result.textContent = mode === "side" ? "" : "comparing\u2026";
    if (mode !== "side") timer = setTimeout(compare, RESTS_MS);
  };
  const compare = async () => {
    const number = asked;
    try {
      const [raster, ray] = await both(), { image, unlike } = differenceOf(raster, ray);
      if (number !== asked) return;
      [canvas.width, canvas.height] = [image.width, image.height];
      canvas.style.aspectRatio = `${image.width} / ${image.height}`;
      canvas.getContext("2d")?.putImageData(image, 0, 0);
      const count = image.width * image.height;
      result.textContent = `${unlike} of ${count} pixels differ by more than 1/255`;
      canvas.setAttribute("aria-label", `Difference of both images: ${result.textContent}`);
    } catch (error) {
      if (number === asked) result.textContent = /** @type {Error} */ (error).message;
    }
  };
  for (const { canvas: restored } of views) restored.addEventListener("webglcontextrestored", update);
  choose(first);
  return { controls: element("div", { class: "lucida-modes", role: "group", "aria-label": "Comparison" }, ...choices, wipe, result), update };
}

let comparisons = 0;

/** Return the difference of two images, brighter, and how many pixels differ by more than 1/255. @param {ImageData} a @param {ImageData} b */
export function differenceOf(a, b) {
  const image = new ImageData(a.width, a.height);
  let unlike = 0;
  for (let at = 0; at < a.data.length; at += 4) {
    let most = 0;
    for (let k = 0; k < 3; k += 1) {
      const off = Math.abs(a.data[at + k] - b.data[at + k]);
      most = Math.max(most, off);
      image.data[at + k] = GAIN * off;
    }
    image.data[at + 3] = 255;
    unlike += most > 1 ? 1 : 0;
  }
  return { image, unlike };
}
