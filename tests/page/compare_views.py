"""Random cameras in a scene's page, in a browser: both of its images against the tracer's.

    python -m tests.page.compare_views --views 200 --scenes still-life columns

Prints a line for each image with unexplained pixels, and a total; the exit status is 1 if there was
any.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from app.page.scene_page import scene_page
from renderer import Tracer, load_scene
from renderer.images import picture
from renderer.scene.model import View
from renderer.scene.views import view_table
from tests.support.browser import Page, chromium, unexplained
from tests.support.page_cameras import random_cameras

SIZE = (160, 120)


def main(argv: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--views", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--scenes", nargs="+", default=["still-life", "columns", "spheres"])
    asked = parser.parse_args(argv)
    end = time.monotonic() + 60 * asked.minutes
    views, found = 0, {"ray": 0, "raster": 0}
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        for name in asked.scenes:
            scene = load_scene(name)
            file = Path(folder) / "page.html"
            file.write_text(scene_page(scene, scene.view), encoding="utf-8")
            page = Page(browser, file)
            page.tab.evaluate("lucida.ready")
            with Tracer(scene) as tracer:
                for camera in random_cameras(asked.seed, asked.views // len(asked.scenes)):
                    if time.monotonic() > end:
                        break
                    views += 1
                    frame = tracer.render(camera, SIZE, ("color", "primitive"))
                    page.tab.evaluate("camera => lucida.set(camera)", view_table(View(camera)))
                    for kind in found:
                        image, seen = page.image(kind, SIZE), frame.channel("primitive")
                        if count := unexplained(image, picture(frame), seen):
                            print(f"{name}, {kind}: {count} pixels, {camera}", flush=True)
                            found[kind] += count
    pixels = views * SIZE[0] * SIZE[1]
    print(f"{views} views, {pixels} pixels of each image; unexplained: {found}")
    return int(any(found.values()))


if __name__ == "__main__":
    raise SystemExit(main())
