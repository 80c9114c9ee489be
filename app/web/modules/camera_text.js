// The camera as text: a view file's TOML, and the part of the address after #.

import { checkedCamera } from "./camera.js";

/** @typedef {import("./camera.js").Camera} Camera */

const ORDER = /** @type {const} */ (["eye", "u", "v", "w", "distance", "viewport", "projection", "near", "far"]);

/** Return a camera as a view file's text, exactly. @param {Camera} camera */
export function tomlOfCamera(camera) {
  const lines = ["lucida = 1", "", "[camera]"];
  for (const name of ORDER) {
    const value = camera[name];
    if (value !== undefined) lines.push(`${name} = ${tomlValue(value)}`);
  }
  if (camera.fit) lines.push("fit = true");
  if (camera.lens) {
    const fields = Object.entries(camera.lens).map(([name, value]) => `${name} = ${tomlValue(value)}`);
    lines.push(`lens = { ${fields.join(", ")} }`);
  }
  return `${lines.join("\n")}\n`;
}

/** @param {string | number | number[]} value @returns {string} */
function tomlValue(value) {
  if (Array.isArray(value)) return `[${value.map(tomlValue).join(", ")}]`;
  if (typeof value === "string") return JSON.stringify(value);
  const text = String(value);
  return /^-?\d+$/.test(text) ? `${text}.0` : text;
}

/** Return a camera as the part of an address after #. @param {Camera} camera */
export function hashOfCamera(camera) {
  return `#camera=${encodeURIComponent(JSON.stringify(camera))}`;
}

/** Return the camera of an address; null for none. Throws an Error for one that cannot be. @param {string} hash @param {Camera} first @returns {Camera | null} */
export function cameraOfHash(hash, first) {
  if (!hash.startsWith("#camera=")) return null;
  let given;
  try {
    given = JSON.parse(decodeURIComponent(hash.slice(8)));
  } catch {
    throw new Error("the address holds no camera");
  }
  if (typeof given !== "object" || given === null || Array.isArray(given)) throw new Error("the address holds no camera");
  return checkedCamera(given, first);
}
