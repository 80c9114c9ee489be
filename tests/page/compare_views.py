"""Random cameras in a scene's page, in a browser: its rays and both images against the program's.

    python -m tests.page.compare_views --views 200 --scenes still-life bunny.obj --browser firefox

Prints a line for each image with unexplained pixels, and a total; the exit status is 1 if there was
any. Counted apart are pixels at which two surfaces coincide, such as a box's bottom with the floor
that it stands on: roundings decide which of both is seen. Explained are pixels whose colour the
program's image shows TOLERANCE_PX away: they are at a hole's border, or at another edge that no
neighbour shows. The cameras see a built-in scene and a file's model alike, some from so near that
it fills the image. Firefox needs a display (xvfb-run): without one it has no WebGL.
"""

from __future__ import annotations

import argparse
import itertools
import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from app.page.scene_page import scene_page
from renderer import Camera, Tracer, load_scene
from renderer.explained import TOLERANCE_PX
from renderer.focus import scene_focus
from renderer.images import picture
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import View
from renderer.scene.views import view_table
from tests.support.browser import Page, chromium, unexplained
from tests.support.firefox import firefox
from tests.support.page_cameras import random_cameras, ray_error
from tests.support.trace_reference import closest

SIZE = (160, 120)
MOST_RAY_ERROR = 1e-12
BROWSERS = {"chromium": chromium, "firefox": firefox}
UNITS = 12  # units of the random cameras in a scene's reach: the nearest ones see little else


def main(argv: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--views", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--scenes", nargs="+", default=["still-life", "columns", "spheres"])
    parser.add_argument("--browser", choices=BROWSERS, default="chromium")
    asked = parser.parse_args(argv)
    end = time.monotonic() + 60 * asked.minutes
    views, coinciding, found, ray_errors = 0, 0, {"ray": 0, "raster": 0}, [0.0]
    with tempfile.TemporaryDirectory() as folder, BROWSERS[asked.browser]() as browser:
        for name in asked.scenes:
            scene = load_scene(name)
            flat, focus = flatten(scene), scene_focus(scene)
            cameras = random_cameras(
                asked.seed, asked.views // len(asked.scenes), focus.center, focus.reach / UNITS
            )
            file = Path(folder) / "page.html"
            file.write_text(scene_page(scene, scene.view), encoding="utf-8")
            page = Page(browser, file, viewport={"width": 240, "height": 240})
            page.tab.evaluate("lucida.ready")
            ray_errors.append(ray_error(page, cameras))
            with Tracer(scene) as tracer:
                for camera in cameras:
                    if time.monotonic() > end:
                        break
                    views += 1
                    frame = tracer.render(camera, SIZE, ("color", "primitive"))
                    page.tab.evaluate("camera => lucida.set(camera)", view_table(View(camera)))
                    for kind in found:
                        image, seen = page.image(kind, SIZE), frame.channel("primitive")
                        pixels = unexplained(image, picture(frame), seen)
                        if pixels.any():
                            pixels &= ~shown_nearby(tracer, camera, image)
                        doubtful = int(doubtful_hits(flat, camera, pixels).sum())
                        coinciding += doubtful
                        if count := int(pixels.sum()) - doubtful:
                            print(f"{name}, {kind}: {count} pixels, {camera}", flush=True)
                            found[kind] += count
            print(f"{name}: {views} views; the page said {page.problems or 'nothing'}", flush=True)
            page.tab.close()
    print(f"{views} views, {views * SIZE[0] * SIZE[1]} pixels of each image; unexplained: {found}")
    print(f"where surfaces coincide, in both images: {coinciding}")
    print(f"rays differ by at most {max(ray_errors):.1e}")
    return int(any(found.values()) or not max(ray_errors) <= MOST_RAY_ERROR)


def shown_nearby(tracer: Tracer, camera: Camera, image: np.ndarray) -> np.ndarray:
    """Return the pixels whose colour the program's image shows TOLERANCE_PX away."""
    left, right, bottom, top = camera.viewport
    across, up = TOLERANCE_PX * (right - left) / SIZE[0], TOLERANCE_PX * (top - bottom) / SIZE[1]
    shown = np.zeros(image.shape[:2], bool)
    for x, y in itertools.product((-across, 0.0, across), (-up, 0.0, up)):
        moved = replace(camera, viewport=(left + x, right + x, bottom + y, top + y))
        near = picture(tracer.render(moved, SIZE, ("color",)))
        shown |= (np.abs(image.astype(int) - near) <= 1).all(axis=2)
    return shown


def doubtful_hits(flat: FlatScene, camera: Camera, pixels: np.ndarray) -> np.ndarray:
    """Return which of some pixels' rays, or of those next to them, meet two surfaces within 1e-9 of
    their distance.
    """
    offsets = np.moveaxis(np.mgrid[-1:2, -1:2], 0, -1).reshape(-1, 1, 2)
    rows, columns = (np.argwhere(pixels) + offsets).reshape(-1, 2).T
    ray = camera.ray(rows, columns, SIZE)
    doubtful = closest(flat, ray.origin, ray.direction, camera.t_range).doubtful
    return doubtful.reshape(9, -1).any(axis=0)


if __name__ == "__main__":
    raise SystemExit(main())
