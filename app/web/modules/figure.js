// A live figure: images of one scene from one camera, beside one another, and what explains them.

import { cameraForSize, checkedCamera, viewingRay } from "./camera.js";
import { comparison } from "./comparing.js";
import { cameraControls } from "./controls.js";
import { element, vectorText } from "./elements.js";
import { movable } from "./hiding.js";
import { addNavigation, drawEnlarged, imageView } from "./image_view.js";
import { orbited, panned, pivotOf, zoomed } from "./navigation.js";
import { outsideView } from "./outside.js";
import { probeView } from "./probe.js";
import { Raster } from "./raster.js";
import { RayClient } from "./ray_client.js";
import { unpackScene } from "./scene.js";

/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Size} Size */
/** @typedef {import("./vectors.js").Vec} Vec */
/** @typedef {import("./scene.js").PackedScene & {shaders: import("./raster.js").ShaderSet, name: string, names: string[]}} PackedScene */
/** @typedef {"raster" | "ray" | "wipe" | "difference" | "outside" | "probe" | "controls"} Shown */
/**
 * @typedef {object} Options
 * @property {Size} [size] of the images; by default as large as there is room
 * @property {number} [aspect] width over height, where the camera fits any
 * @property {Partial<import("./ray.js").Effects>} [effects]
 * @property {import("./comparing.js").Mode} [mode] how both images are compared at first
 * @property {import("./outside.js").OutsideParts} [outside] of the outside view: its camera, and what it draws
 * @property {[number, number]} [mark] the marked pixel's row and column from 0, where size is given
 * @property {0 | 1} [from] what the first row and column are called; 0 by default
 * @property {(camera: Camera) => void} [onChange] is told of another camera
 * @property {(scene: import("./scene.js").Scene, place: Vec) => void} [onShift] is told where an object was moved
 */
/** @typedef {{set: (camera: Partial<Camera>) => void, camera: Camera, dispose: () => void, ready: Promise<void>, pixels: (kind: "ray" | "raster", size: Size) => Promise<ImageData>}} LiveFigure */

const MOST_PIXELS = 800 * 600;
const TITLES = { raster: "Raster image: object order", ray: "Ray image: image order" };

/**
 * Put a live figure into an element.
 * @param {HTMLElement} parent
 * @param {{scene: PackedScene, camera: Camera, shows: Shown[], options?: Options}} content
 * @returns {LiveFigure}
 */
export function figure(parent, { scene: packed, camera: first, shows, options = {} }) {
  const effects = { shadows: false, mirrors: 0, exposure: 0, ...options.effects };
  const images = element("div", { class: "lucida-images" }), root = element("div", { class: "lucida-figure" });
  parent.append(root);
  let camera = first, frame = 0, probes = 0, isDisposed = false;
  let middle = /** @type {Vec} */ ([0, 0, 0]);
  const { size: given, mark: marked, from = 0 } = options;
  // Of the mark: parts of the image.
  let place = /** @type {[number, number]} */ (given && marked ? [(marked[1] + 0.5) / given[0], (marked[0] + 0.5) / given[1]] : [0.5, 0.5]);
  let hit = /** @type {import("./probe.js").ProbedHit | null} */ (null);
  /** @type {Raster | undefined} */
  let raster;
  /** @type {RayClient | undefined} */
  let rays;
  /** @type {ReturnType<typeof outsideView> | undefined} */
  let outside;
  /** @type {ReturnType<typeof cameraControls> | undefined} */
  let controls;
  const views = (/** @type {("raster" | "ray")[]} */ (["raster", "ray"])).filter((kind) => shows.includes(kind))
    .map((kind) => ({ kind, ...imageView(TITLES[kind]) }));
  const rayView = views.find(({ kind }) => kind === "ray"), rasterView = views.find(({ kind }) => kind === "raster");
  images.append(...views.map(({ view }) => view));
  root.append(images);

  /** Return the size of the images that there is room for. @returns {Size} */
  const imageSize = () => {
    if (options.size) return options.size;
    const [left, right, bottom, top] = camera.viewport;
    const aspect = camera.fit ? options.aspect ?? 1.5 : Math.min(Math.max((right - left) / (top - bottom), 0.2), 5);
    const room = (images.clientWidth || 320) / (views.length > 1 && images.clientWidth > 656 && !images.dataset.mode?.includes("wipe") ? 2 : 1);
    const width = Math.min(room * Math.min(devicePixelRatio, 1.5), Math.sqrt(MOST_PIXELS * aspect));
    return [Math.max(1, Math.round(width)), Math.max(1, Math.round(width / aspect))];
  };
  /** Return the marked pixel. @param {Size} size @returns {[number, number]} */
  const pixelOf = ([width, height]) => [Math.min(Math.floor(place[1] * height), height - 1), Math.min(Math.floor(place[0] * width), width - 1)];
  const isMarking = shows.includes("probe") || (shows.includes("outside") && options.outside?.ray !== false);

  /** @param {number} rows @param {number} columns */
  const step = (rows, columns) => {
    const size = imageSize(), [row, column] = pixelOf(size);
    mark((Math.min(Math.max(column + columns, 0), size[0] - 1) + 0.5) / size[0], (Math.min(Math.max(row + rows, 0), size[1] - 1) + 0.5) / size[1]);
  };
  const probe = shows.includes("probe") ? probeView(step, from) : undefined;
  /** @param {number} x @param {number} y */
  const mark = (x, y) => {
    place = [x, y];
    redraw();
  };

  const explain = () => {
    const size = imageSize(), fitted = cameraForSize(camera, size), pixel = pixelOf(size);
    for (const { view } of views) {
      view.style.setProperty("--x", `${(100 * (pixel[1] + 0.5)) / size[0]}%`);
      view.style.setProperty("--y", `${(100 * (pixel[0] + 0.5)) / size[1]}%`);
    }
    const ray = viewingRay(fitted, ...pixel, size);
    outside?.show(camera, size, isMarking && !Number.isNaN(ray.direction[0]) ? { ...ray, t: hit ? hit.t : Infinity } : null);
    probe?.show(fitted, size, pixel, hit);
  };

  const draw = async () => {
    frame = 0;
    const size = imageSize();
    for (const { kind, canvas } of views) {
      canvas.style.aspectRatio = `${size[0]} / ${size[1]}`;
      root.style.setProperty("--aspect", String(size[0] / size[1]));
      canvas.setAttribute("aria-label", `${TITLES[kind]}, ${packed.name}, ${size[0]} x ${size[1]} pixels, from the eye ${vectorText(camera.eye, 3)}, ${camera.projection}`);
    }
    if (rasterView) raster?.show(camera, size, effects.exposure);
    if (rayView) rays?.follow({ camera, size, effects });
    controls?.show(cameraForSize(camera, size));
    explain();
    if (!isMarking || !rays) return;
    const number = (probes += 1), found = await rays.probe({ camera, size, effects }, pixelOf(size));
    if (number !== probes || isDisposed) return;
    hit = { ...found, name: packed.names[found.object] ?? "" };
    explain();
  };
  const redraw = () => void (frame ||= requestAnimationFrame(draw));

  /** @param {Camera} next */
  const change = (next) => {
    camera = next;
    redraw();
    compared?.update();
    options.onChange?.(camera);
  };
  /** Change some fields; with values that no camera can have, the last one stays. @param {(camera: Camera) => Partial<Camera>} fields */
  const edit = (fields) => {
    try {
      change(checkedCamera(fields(cameraForSize(camera, imageSize())), camera));
    } catch {
      redraw(); // the fields show the last camera again
    }
  };
  const pivot = () => pivotOf(camera, middle);
  for (const { canvas, view } of views) {
    view.classList.toggle("marked", isMarking);
    addNavigation(canvas, {
      orbit: (x, y) => change(orbited(camera, pivot(), -3 * x, -2 * y)),
      pan: (x, y) => change(panned(cameraForSize(camera, imageSize()), pivot(), x, y)),
      zoom: (factor) => change(zoomed(camera, pivot(), factor)),
      mark,
      step,
    });
  }

  /** @param {"ray" | "raster"} kind @param {Size} size */
  const pixels = async (kind, size) => {
    await ready;
    if (kind === "ray") return /** @type {RayClient} */ (rays).image({ camera, size, effects });
    if (!raster) throw new Error("there is no raster image here");
    const image = raster.pixels(camera, size, effects.exposure);
    redraw();
    return image;
  };
  const modes = /** @type {const} */ (["side", "wipe", "difference"]).filter((mode) => mode === "side" || shows.includes(mode));
  const compared = views.length > 1 && modes.length > 1
    ? comparison(images, views, modes, options.mode ?? "side", async () => {
      const size = imageSize();
      return [await pixels("raster", size), await pixels("ray", size)];
    })
    : undefined;
  if (compared) images.before(compared.controls);

  /** @param {import("./ray_client.js").RayImage} image */
  const showRays = (image) => {
    if (rayView) drawEnlarged(rayView.canvas, imageSize(), image);
    if (image.factor === 1) explain();
  };
  /** @param {typeof views[number]} view @param {string} reason */
  const showNoRaster = (view, reason) => {
    views.splice(views.indexOf(view), 1);
    view.view.remove();
    compared?.controls.remove();
    images.before(element("p", { role: "status" }, `No raster image: ${reason}. The ray image needs none.`));
  };

  const resizing = new ResizeObserver(redraw);
  const ready = (async () => {
    const loaded = movable(await unpackScene(packed));
    middle = /** @type {Vec} */ ([0, 1, 2].map((k) => (loaded.focus[k] + loaded.focus[3 + k]) / 2));
    /** @param {HTMLCanvasElement} canvas */
    const newRaster = (canvas) => {
      try {
        return new Raster(canvas, loaded, packed.shaders);
      } catch (error) {
        if (canvas === rasterView?.canvas) showNoRaster(rasterView, /** @type {Error} */ (error).message);
        return undefined;
      }
    };
    if (rasterView) raster = newRaster(rasterView.canvas);
    rays = new RayClient(loaded, showRays, rayView ? undefined : 1);
    const aside = element("div", { class: "lucida-aside" });
    if (shows.includes("outside")) {
      outside = outsideView(camera, loaded, newRaster, options.outside ?? {}, (fields) => edit(() => fields), (place) => {
        rays?.load(loaded);
        redraw();
        options.onShift?.(loaded, place);
      });
      aside.append(outside.view);
    }
    if (probe) aside.append(probe.view);
    if (aside.children.length) root.append(aside);
    if (shows.includes("controls")) {
      controls = cameraControls(first, loaded, edit, effects, () => {
        redraw();
        compared?.update();
      });
      root.append(controls.view);
    }
    if (!isDisposed) await draw();
    resizing.observe(images);
  })();

  return {
    get camera() {
      return camera;
    },
    set(given) {
      change(checkedCamera(given, camera));
    },
    ready,
    pixels,
    dispose() {
      isDisposed = true;
      cancelAnimationFrame(frame);
      resizing.disconnect();
      raster?.dispose();
      outside?.dispose();
      rays?.dispose();
      root.remove();
    },
  };
}
