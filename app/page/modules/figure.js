// A live figure: images of one scene from one camera, beside one another, and what explains them.

import { cameraForSize, checkedCamera } from "./camera.js";
import { element } from "./elements.js";
import { addNavigation, imageView } from "./image_view.js";
import { orbited, panned, pivotOf, zoomed } from "./navigation.js";
import { Raster } from "./raster.js";
import { RayClient } from "./ray_client.js";
import { unpackScene } from "./scene.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./scene.js").PackedScene & {shaders: import("./raster.js").ShaderSet, name: string}} PackedScene */
/** @typedef {"raster" | "ray" | "wipe" | "difference" | "outside" | "probe" | "array"} Shown */
/**
 * @typedef {object} Options
 * @property {Size} [size] of the images; by default as large as there is room
 * @property {number} [aspect] width over height, where the camera fits any
 * @property {Partial<import("./ray.js").Effects>} [effects]
 * @property {(camera: Camera) => void} [onChange] is told of another camera
 */
/** @typedef {{set: (camera: Partial<Camera>) => void, camera: Camera, dispose: () => void, ready: Promise<void>, pixels: (kind: "ray" | "raster", size: Size) => Promise<ImageData>}} LiveFigure */

const MOST_PIXELS = 640 * 480;
const TITLES = { raster: "Raster image: object order", ray: "Ray image: image order" };

/**
 * Put a live figure into an element.
 * @param {HTMLElement} parent
 * @param {{scene: PackedScene, camera: Camera, shows: Shown[], options?: Options}} content
 * @returns {LiveFigure}
 */
export function figure(parent, { scene: packed, camera: first, shows, options = {} }) {
  const effects = { shadows: false, mirrors: 0, exposure: 0, ...options.effects };
  const root = element("div", { class: "lucida-figure" }), images = element("div", { class: "lucida-images" });
  root.append(images);
  parent.append(root);
  let camera = first, frame = 0;
  /** @type {Raster | undefined} */
  let raster;
  /** @type {RayClient | undefined} */
  let rays;
  let middle = /** @type {Vec} */ ([0, 0, 0]);
  const views = (/** @type {("raster" | "ray")[]} */ (["raster", "ray"])).filter((kind) => shows.includes(kind))
    .map((kind) => ({ kind, ...imageView(TITLES[kind]) }));
  images.append(...views.map(({ view }) => view));

  /** Return the size of the images that there is room for. @returns {Size} */
  const imageSize = () => {
    if (options.size) return options.size;
    const [left, right, bottom, top] = camera.viewport;
    const aspect = camera.fit ? options.aspect ?? 1.5 : (right - left) / (top - bottom);
    const room = views[0]?.canvas.clientWidth || 320, scale = Math.min(devicePixelRatio, 1.5);
    const width = Math.min(room * scale, Math.sqrt(MOST_PIXELS * aspect));
    return [Math.max(1, Math.round(width)), Math.max(1, Math.round(width / aspect))];
  };

  const draw = () => {
    frame = 0;
    const size = imageSize();
    for (const { kind, canvas } of views) {
      canvas.style.aspectRatio = `${size[0]} / ${size[1]}`;
      if (kind === "raster") raster?.show(camera, size, effects.exposure);
      else rays?.follow({ camera, size, effects });
    }
  };
  const redraw = () => void (frame ||= requestAnimationFrame(draw));

  /** @param {Camera} next */
  const change = (next) => {
    camera = next;
    redraw();
    options.onChange?.(camera);
  };

  const pivot = () => pivotOf(camera, middle);
  for (const { canvas } of views) {
    addNavigation(canvas, {
      orbit: (x, y) => change(orbited(camera, pivot(), -3 * x, -2 * y)),
      pan: (x, y) => change(panned(cameraForSize(camera, imageSize()), pivot(), x, y)),
      zoom: (factor) => change(zoomed(camera, pivot(), factor)),
      mark: () => undefined,
      step: () => undefined,
    });
  }

  const resizing = new ResizeObserver(redraw);
  resizing.observe(images);

  /** @param {import("./ray.js").ImagePart} part */
  const showRays = ({ width, height, factor, bytes }) => {
    const view = views.find(({ kind }) => kind === "ray"), [w, h] = imageSize();
    if (!view) return;
    const context = /** @type {CanvasRenderingContext2D} */ (view.canvas.getContext("2d"));
    if (view.canvas.width !== w || view.canvas.height !== h) [view.canvas.width, view.canvas.height] = [w, h];
    const small = document.createElement("canvas");
    [small.width, small.height] = [width, height];
    small.getContext("2d")?.putImageData(new ImageData(/** @type {any} */ (bytes), width, height), 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(small, 0, 0, width * factor, height * factor);
  };

  const ready = (async () => {
    const scene = await unpackScene(packed);
    middle = /** @type {Vec} */ ([0, 1, 2].map((k) => (scene.bounds[k] + scene.bounds[3 + k]) / 2));
    const view = views.find(({ kind }) => kind === "raster");
    if (view) {
      try {
        raster = new Raster(view.canvas, scene, packed.shaders);
      } catch (error) {
        view.caption.textContent = `No raster image: ${/** @type {Error} */ (error).message}. The ray image needs none.`;
      }
    }
    rays = new RayClient(scene, showRays);
    draw();
  })();

  return {
    get camera() {
      return camera;
    },
    set(given) {
      change(checkedCamera(given, camera));
    },
    ready,
    async pixels(kind, size) {
      await ready;
      if (kind === "ray") return /** @type {RayClient} */ (rays).image({ camera, size, effects });
      if (!raster) throw new Error("this browser has no WebGL 2");
      const image = raster.pixels(camera, size, effects.exposure);
      redraw();
      return image;
    },
    dispose() {
      cancelAnimationFrame(frame);
      resizing.disconnect();
      raster?.dispose();
      rays?.dispose();
      root.remove();
    },
  };
}
