// The scene: what app/web/packing.py has packed, as arrays. Names and shapes are FlatScene's in
// renderer/scene/flat.py.

import { TEXEL_BITS } from "./numbers.js";

/**
 * @typedef {object} PackedScene
 * @property {Record<string, [string, string]>} arrays type and base64 by name
 * @property {number[]} sphere_object
 * @property {{first: number, opacity: boolean, values: number[], png: string}[]} images
 * @property {number} arrow the length of a unit vector's arrow in the outside view
 */
/**
 * @typedef {object} Scene
 * @property {Float32Array} vertices 3 each, in their object's space
 * @property {Float32Array} normals 3 each, in the world; empty if all surfaces are flat
 * @property {Float32Array} colors 3 each; empty if all are white
 * @property {Float32Array} uv 2 each, in texels; empty without textures
 * @property {Int32Array} faces three vertices each
 * @property {Int32Array} faceObject
 * @property {Float64Array} spheres centre and radius, 4 each
 * @property {Int32Array} sphereObject
 * @property {Int32Array} objectFaces first and count
 * @property {Int32Array} objectVertices first and count
 * @property {Float64Array} objectBounds 6 each, lowest and highest corner in the object's space
 * @property {Float64Array} worldFromObject 16 each, row by row
 * @property {Float32Array} materials 12 each
 * @property {Float64Array} cells 12 each
 * @property {Int32Array} textures 8 each
 * @property {Int32Array} texels
 * @property {Uint8Array} singleSided
 * @property {Float64Array} lights 8 each
 * @property {Float32Array} ambient
 * @property {Float32Array} background
 * @property {Float64Array} bounds 6, around everything
 * @property {Float64Array} focus 6, around what a picture must contain: not a floor or a sky
 * @property {number} arrow as packed
 */

const ARRAY_TYPES = { Float32Array, Float64Array, Int32Array, Uint8Array };

/** @type {WeakMap<PackedScene, Promise<Scene>>} */
const unpackedScenes = new WeakMap();

/** Return a packed scene's arrays, unpacked once. @param {PackedScene} packed */
export function unpackScene(packed) {
  const known = unpackedScenes.get(packed);
  if (known) return known;
  const scene = unpack(packed);
  unpackedScenes.set(packed, scene);
  return scene;
}

/** @param {PackedScene} packed @returns {Promise<Scene>} */
async function unpack(packed) {
  /** @type {any} */
  const scene = {};
  for (const [name, [type, text]] of Object.entries(packed.arrays)) {
    const Type = ARRAY_TYPES[/** @type {keyof typeof ARRAY_TYPES} */ (type)];
    scene[camelCase(name)] = new Type(bytesOfText(text).buffer);
  }
  scene.faceObject = new Int32Array(scene.faces.length / 3);
  for (let k = 0; k < scene.objectFaces.length / 2; k += 1) {
    const first = scene.objectFaces[2 * k];
    scene.faceObject.fill(k, first, first + scene.objectFaces[2 * k + 1]);
  }
  scene.sphereObject = Int32Array.from(packed.sphere_object);
  scene.arrow = packed.arrow;
  scene.texels = await texelsOf(packed.images);
  return scene;
}

/** @param {string} name */
const camelCase = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

/** @param {string} text base64 */
export function bytesOfText(text) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let k = 0; k < bytes.length; k += 1) bytes[k] = letters.charCodeAt(k);
  return bytes;
}

/** @param {PackedScene["images"]} images @returns {Promise<Int32Array>} */
async function texelsOf(images) {
  const parts = await Promise.all(images.map((image) => decoded(image)));
  const last = images.length - 1;
  const texels = new Int32Array(last < 0 ? 0 : images[last].first + parts[last].length);
  images.forEach((image, k) => texels.set(parts[k], image.first));
  return texels;
}

/** @param {PackedScene["images"][number]} image */
async function decoded({ png, values, opacity }) {
  const blob = new Blob([bytesOfText(png)], { type: "image/png" });
  const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none", premultiplyAlpha: "none" });
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  const texels = new Int32Array(data.length / 4);
  for (let k = 0; k < texels.length; k += 1) {
    const red = values[data[4 * k]];
    if (opacity) texels[k] = red;
    else texels[k] = red | (values[data[4 * k + 1]] << TEXEL_BITS) | (values[data[4 * k + 2]] << (2 * TEXEL_BITS));
  }
  return texels;
}

/** Return the number of an object that a primitive belongs to. @param {Scene} scene @param {number} primitive */
export function objectOf(scene, primitive) {
  const triangles = scene.faceObject.length;
  return primitive < triangles ? scene.faceObject[primitive] : scene.sphereObject[primitive - triangles];
}

/** Return the number of objects. @param {Scene} scene */
export const objectCount = (scene) => scene.singleSided.length;
