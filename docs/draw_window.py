"""Draws the pictures of the window in docs/ from the real window: `make pictures`.

    python docs/draw_window.py [NAME ...]

Owns what each picture shows. No display is needed.
"""

from __future__ import annotations

import itertools
import math
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from PIL import Image

from lucida.app.instruments.objects.choosing import choose, rows_of
from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.state.app_state import AppState
from lucida.app.ui import layout
from lucida.app.window.canvas import Target
from lucida.app.window.platform import start_platform
from lucida.app.window.start import first_state
from lucida.app.window.viewer import WindowRun, save_png
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.camera.navigation import orbited
from lucida.renderer.files import load_scene

FOLDER = Path(__file__).parent
MOVING = "moving"  # the picture in which the eye moves, moving.webp
MOVING_SIZE = (1120, 630)
MOVING_FRAMES, MOVING_FRAME_MS, MOVING_RAD = 36, 100, 0.35  # there and back, this far around
LAYOUT_AT = 3  # the frame in which the layout is chosen; the first ones are HelloImGui's own


@dataclass(frozen=True)
class Picture:
    """options: as Options.with_changes() takes them. step: its title in the built-in lecture, which
    says what is to be seen; empty: none. code: a student's file. chosen: an object, by its name.
    views: shown in addition to the layout's."""

    name: str
    layout: str = layout.LAYOUTS[0].name
    scene: str = "still-life"
    size: tuple[int, int] = (1280, 720)
    options: dict[str, Any] = field(default_factory=dict)
    step: str = ""
    code: str = ""
    chosen: str = ""
    views: tuple[str, ...] = ()
    lens: Lens | None = None  # of a wide-angle camera


WRONG = """\
def viewing_ray(i, j, width, height, camera):
    x = camera.left + j / width * (camera.right - camera.left)
    y = camera.bottom + (i + 0.5) / height * (camera.top - camera.bottom)
    d = camera.distance
    return camera.eye, [x * u + y * v - d * w for u, v, w in zip(camera.u, camera.v, camera.w)]
"""

PICTURES = (
    Picture("window"),
    Picture("outside", "Outside view"),
    Picture("compare", "Compare", "spheres", options={"compare": {"mode": "wipe"}}),
    Picture("probe", "Probe", "primitives", (1600, 900), {"marked": (190, 150)}),
    Picture("loops", "Loops", "still-life", (1600, 900), {"stepper": {"steps": (1010, 4720)}}),
    Picture("your-code", layout.LOOPS, size=(1600, 900), code=WRONG),
    Picture("scene", "Four views", size=(1600, 900), chosen="box", views=("Objects", "Inspector")),
    Picture("lecture", step="Any camera", size=(1600, 900)),
    Picture("lenses", scene="columns", lens=Lens("brown", {"k1": -0.25, "k2": 0.06})),
)


def draw(picture: Picture, folder: Path = FOLDER) -> Path:
    """Draws one picture; gives its file."""
    path = folder / f"{picture.name}.png"
    if picture.step:
        lecture = load_lecture(BUILTIN)
        number = [step.title for step in lecture.steps].index(picture.step)
        state = first_state(lecture, (number, 0))
        run = WindowRun(start_platform(want_display=False), state, picture.size, take_picture=True)
        run.window.lecture.give(lecture, BUILTIN, (number, 0))
        save_png(path, run.run())
        return path
    state = AppState.for_scene(load_scene(picture.scene))
    state = state.with_options(state.options.with_changes(picture.options))
    if picture.lens is not None:
        camera = replace(state.camera, distance=0.8, lens=picture.lens)
        state = state.with_camera(camera)
    state = choose(state, [row.item for row in rows_of(state.scene) if row.shown == picture.chosen])
    run = WindowRun(start_platform(want_display=False), state, picture.size, take_picture=True)
    run.params.callbacks.post_new_frame = _chooser(run, picture)
    with tempfile.TemporaryDirectory() as scratch:
        if picture.code:
            file = Path(scratch, "rays.py")
            file.write_text(picture.code)
            run.window.open_code(str(file))
        save_png(path, run.run())
    return path


def draw_moving(folder: Path = FOLDER) -> Path:
    """Draws the window while the eye moves around the scene and back; gives its file."""
    state = AppState.for_scene(load_scene("still-life"))
    run = WindowRun(start_platform(want_display=False), state, MOVING_SIZE, take_picture=True)
    run.take_picture = False
    pictures: list[Image.Image] = []

    def take(target: Target) -> None:
        if not run.window.settled:
            return
        pictures.append(Image.fromarray(target.read()))
        angle = MOVING_RAD * math.sin(2 * math.pi * len(pictures) / MOVING_FRAMES)
        camera = orbited(state.camera, run.window.focus.center, angle, 0.0)
        run.window.amend(state.with_camera(camera))
        run.params.app_shall_exit = len(pictures) == MOVING_FRAMES

    run.on_drawn = take
    run.run()
    path = folder / f"{MOVING}.webp"
    first, *others = pictures
    how = {"duration": MOVING_FRAME_MS, "loop": 0, "quality": 45, "method": 6}
    first.save(path, save_all=True, append_images=others, **how)
    return path


def _chooser(run: WindowRun, picture: Picture) -> Callable[[], None]:
    frames = itertools.count(1)

    def choose() -> None:
        frame = next(frames)
        if frame == LAYOUT_AT:
            layout.switch(picture.layout)
        elif frame == 2 * LAYOUT_AT:
            for name in picture.views:
                run.window.shell.stage.show(name)

    return choose


def main(names: list[str]) -> int:
    if names == [MOVING]:
        print(draw_moving())
    elif len(names) == 1:
        print(draw(next(picture for picture in PICTURES if picture.name == names[0])))
    else:  # a process has one window
        for name in names or [*(picture.name for picture in PICTURES), MOVING]:
            subprocess.run([sys.executable, __file__, name], check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
