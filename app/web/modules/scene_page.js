// A page of one scene: what `lucida page` writes.

import { cameraOfHash, hashOfCamera, tomlOfCamera } from "./camera_text.js";
import { element } from "./elements.js";
import { figure } from "./figure.js";
import { hooks } from "./hooks.js";

/** @typedef {import("./camera.js").Camera} Camera */

const HASH_DELAY_MS = 300;

/** Start the page. */
export function start() {
  const data = JSON.parse(document.getElementById("lucida-data")?.textContent ?? "");
  const parent = /** @type {HTMLElement} */ (document.getElementById("lucida-figure"));
  const { show, view, say } = textControls(data.camera, (camera) => live.set(camera));
  let camera = /** @type {Camera} */ (data.camera);
  try {
    camera = cameraOfHash(location.hash, camera) ?? camera;
  } catch (error) {
    say(/** @type {Error} */ (error).message);
  }
  const live = figure(parent, { scene: data.scene, camera, shows: data.shows, options: { onChange: show } });
  parent.append(view);
  Object.assign(window, { lucida: hooks(live) });
  window.addEventListener("hashchange", ({ newURL }) => {
    try {
      const given = cameraOfHash(new URL(newURL).hash, data.camera);
      if (given) live.set(given);
    } catch (error) {
      say(/** @type {Error} */ (error).message);
    }
  });
}

/** Return the camera as text to copy, and a function that shows it there and in the address. @param {Camera} first @param {(camera: Camera) => void} set */
function textControls(first, set) {
  const text = element("textarea", { readonly: true, rows: "10", spellcheck: "false", "aria-label": "The camera as a view file" });
  const said = element("span", { role: "status" });
  const copy = element("button", { type: "button" }, "Copy"), link = element("button", { type: "button" }, "Copy link"), reset = element("button", { type: "button" }, "Reset camera");
  let camera = first, timer = 0;
  /** @param {string} what @param {string} copied */
  const put = async (what, copied) => {
    try {
      await navigator.clipboard.writeText(what);
      said.textContent = copied;
    } catch {
      text.select();
      said.textContent = "Press Ctrl+C to copy";
    }
  };
  copy.addEventListener("click", () => put(text.value, "The camera is copied"));
  link.addEventListener("click", () => put(location.href.split("#")[0] + hashOfCamera(camera), "The link is copied"));
  reset.addEventListener("click", () => set(first));
  text.value = tomlOfCamera(first);
  return {
    view: element("section", { class: "lucida-text", "aria-label": "Camera as text" }, element("h2", {}, "The camera as text"),
      element("p", {}, "A view file: paste it into Lucida, or save it for ", element("code", {}, "lucida render --view"), ". The address of this page holds the camera, too."),
      text, element("p", {}, copy, " ", link, " ", reset, " ", said)),
    /** @param {string} message */
    say: (message) => void (said.textContent = message),
    /** @param {Camera} next */
    show(next) {
      camera = next;
      text.value = tomlOfCamera(camera);
      clearTimeout(timer);
      timer = setTimeout(() => history.replaceState(null, "", hashOfCamera(camera)), HASH_DELAY_MS);
    },
  };
}
