// Object order on WebGL 2: for each object, for each pixel that it covers, keep the nearest
// primitive; then for each pixel, from its primitive to the hit and its colour. The shaders are
// those of shaders/, made GLSL ES by app/web/glsl.py; their input comes from setup.js.

import { cameraForSize } from "./camera.js";
import { element } from "./elements.js";
import { facesOfLens } from "./lens_faces.js";
import { byteOfLight } from "./numbers.js";
import { cameraBlock, imageSpace, lightRows, marginOf, objectRows, sphereRows, trianglePlanes, triangleRows } from "./setup.js";
import { cross, dot } from "./vectors.js";
import { GpuStore, linkProgram } from "./webgl.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {import("./setup.js").RasterView} RasterView */
/** @typedef {import("./webgl.js").Target} Target */
/** @typedef {Record<"clear" | "triangles" | "spheres" | "shade", [string, string]>} Shaders vertex and fragment shader of each pass */
/** @typedef {{pinhole: Shaders, lens: Shaders}} ShaderSet */

const BOX_VERTICES = 36; // of the box around a sphere
const LOST = "The WebGL context of this image is lost; the image is drawn again when the browser restores it.";

/** A scene in the WebGL context of a canvas. Throws an Error where there is no WebGL 2. */
export class Raster {
  /** @param {HTMLCanvasElement} canvas @param {Scene} scene @param {ShaderSet} shaders */
  constructor(canvas, scene, shaders) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.gl = gl;
    this.canvas = canvas;
    this.scene = scene;
    this.shaders = shaders;
    /** @type {Map<string, WebGLProgram>} */
    this.programs = new Map();
    this.store = new GpuStore(gl);
    this.planes = trianglePlanes(scene);
    this.rows = new Float32Array(4 * scene.faceObject.length);
    /** @type {Parameters<Raster["show"]> | undefined} the arguments of the last image */
    this.last = undefined;
    this.isDisposed = false;
    this.note = element("p", { role: "status" });
    canvas.parentElement?.after(this.note);
    canvas.addEventListener("webglcontextlost", (event) => {
      if (this.isDisposed) return;
      event.preventDefault(); // otherwise the browser never restores the context
      this.note.textContent = LOST;
    });
    canvas.addEventListener("webglcontextrestored", () => {
      this.programs.clear();
      this.store = new GpuStore(gl);
      this.storeScene();
      if (this.last) this.show(...this.last);
      this.note.textContent = "";
    });
    this.storeScene();
  }

  /** Store what does not depend on the camera, in a new or a restored context. */
  storeScene() {
    const { gl, scene, store } = this, count = scene.vertices.length / 3;
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, gl.createBuffer());
    const faces = new Int32Array(4 * scene.faceObject.length), vertices = new Float32Array(12 * count);
    for (let n = 0; n < scene.faceObject.length; n += 1) {
      faces.set(scene.faces.subarray(3 * n, 3 * n + 3), 4 * n);
      faces[4 * n + 3] = scene.faceObject[n];
    }
    for (let n = 0; n < count; n += 1) {
      // Position, normal and colour: a texel each.
      vertices.set(scene.vertices.subarray(3 * n, 3 * n + 3), 12 * n);
      if (scene.normals.length) vertices.set(scene.normals.subarray(3 * n, 3 * n + 3), 12 * n + 4);
      vertices.set(scene.colors.length ? scene.colors.subarray(3 * n, 3 * n + 3) : [1, 1, 1], 12 * n + 8);
    }
    store.table("faces", faces, 4);
    store.table("vertices", vertices, 4);
    store.table("texels", scene.texels, 1);
    store.table("textures", scene.textures, 4);
    store.table("uv", scene.uv.length ? scene.uv : new Float32Array((2 * scene.vertices.length) / 3), 2);
  }

  /** Use the program of a pass, compiled at its first use. @param {keyof Shaders} name @param {boolean} hasLens */
  use(name, hasLens) {
    const key = `${name} ${hasLens}`, { gl } = this;
    const program = this.programs.get(key) ?? linkProgram(gl, this.shaders[hasLens ? "lens" : "pinhole"][name]);
    this.programs.set(key, program);
    gl.useProgram(program);
    return program;
  }

  /**
   * Draw the image into a framebuffer of its own, row 0 at the top.
   * @param {Camera} camera @param {Size} size @param {number} exposure in stops @returns {Target}
   */
  draw(camera, size, exposure) {
    const fitted = cameraForSize(camera, size), { gl, store } = this, gain = 2 ** exposure;
    if (!fitted.lens) {
      this.see({ camera: fitted, size });
      return this.shade(size, gain, -1);
    }
    const { views, positions } = facesOfLens(fitted, size), image = store.target("image", size, true);
    store.table("positions", positions, 4, size);
    const [red, green, blue] = Array.from(this.scene.background, (light) => byteOfLight(light, gain) / 255);
    gl.clearBufferfv(gl.COLOR, 0, [red, green, blue, 1]);
    views.forEach((view, face) => {
      this.see(view);
      this.shade(size, gain, face);
    });
    return image;
  }

  /** First pass: the nearest primitive of each pixel. @param {RasterView} view */
  see(view) {
    const { gl, scene, store } = this, [width, height] = view.size, hasLens = view.unit !== undefined;
    const space = imageSpace(view, scene), objects = objectRows(scene, view.camera, space);
    gl.bufferData(gl.UNIFORM_BUFFER, cameraBlock(view, space, scene), gl.DYNAMIC_DRAW);
    triangleRows(scene, this.planes, view.camera, space, this.rows);
    store.table("triangle_rows", this.rows, 4);
    store.table("objects", objects, 4);
    store.table("lights", lightRows(scene, view.camera), 4);
    store.table("spheres", sphereRows(scene, view.camera, space, objects), 4);
    store.target("seen", view.size, false);
    const x = marginOf(width), y = marginOf(height), triangles = scene.faceObject.length;
    gl.viewport(-x, -y, width + 2 * x, height + 2 * y);
    gl.clearBufferiv(gl.COLOR, 0, [-1, 0, 0, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    if (triangles) {
      this.use("triangles", hasLens);
      gl.drawArrays(gl.TRIANGLES, 0, 3 * triangles);
    }
    if (scene.sphereObject.length) {
      const program = this.use("spheres", hasLens), { u, v, w } = view.camera;
      gl.uniform1i(gl.getUniformLocation(program, "triangle_count"), triangles);
      gl.enable(gl.CULL_FACE);
      gl.cullFace(gl.FRONT); // far sides only; the image is flipped, and a left-handed basis flips it again
      gl.frontFace(dot(u, cross(v, w)) > 0 ? gl.CW : gl.CCW);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, BOX_VERTICES, scene.sphereObject.length);
      gl.disable(gl.CULL_FACE);
    }
    gl.disable(gl.DEPTH_TEST);
  }

  /** Second pass: the colour of each pixel. @param {Size} size @param {number} gain @param {number} face the lens's, or -1 @returns {Target} */
  shade(size, gain, face) {
    const { gl, store } = this, program = this.use("shade", face >= 0), image = store.target("image", size, true);
    store.bind("primitives", /** @type {Target} */ (store.targets.get("seen")).texture);
    gl.viewport(0, 0, ...size);
    gl.uniform1f(gl.getUniformLocation(program, "exposure"), gain);
    gl.uniform1f(gl.getUniformLocation(program, "window_depth"), 0);
    gl.uniform1i(gl.getUniformLocation(program, "face"), face);
    gl.uniform1i(gl.getUniformLocation(program, "triangle_count"), this.scene.faceObject.length);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return image;
  }

  /** Draw the image on the canvas. @param {Camera} camera @param {Size} size @param {number} exposure */
  show(camera, size, exposure) {
    const { gl, canvas } = this, [width, height] = size;
    this.last = [camera, size, exposure];
    if (gl.isContextLost()) return;
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = size;
    const image = this.draw(camera, size, exposure);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, image.framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    // A canvas has row 0 at the bottom.
    gl.blitFramebuffer(0, 0, width, height, 0, height, width, 0, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  /** Return the image, by way of the canvas, which is to be drawn anew. @param {Camera} camera @param {Size} size @param {number} exposure */
  pixels(camera, size, exposure) {
    if (this.gl.isContextLost()) throw new Error(LOST);
    const copy = element("canvas", { width: String(size[0]), height: String(size[1]) });
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext("2d", { willReadFrequently: true }));
    this.show(camera, size, exposure);
    context.drawImage(this.canvas, 0, 0);
    return context.getImageData(0, 0, ...size);
  }

  /** Give the context back: a browser has few. */
  dispose() {
    this.isDisposed = true;
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}
