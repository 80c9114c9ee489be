"""Implement `lucida [SCENE]`: open a scene in a window, or draw it once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from lucida.app.images.imaging import with_resolution
from lucida.app.images.photograph.model import with_photograph
from lucida.app.instruments.outside.view import OUTSIDE
from lucida.app.instruments.poses.model import PoseSet, with_set, with_set_framed
from lucida.app.instruments.probe.view import PROBE
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.state.paths import stored
from lucida.app.ui import layout
from lucida.renderer.files import EMPTY_SCENE
from lucida.renderer.scene import Scene
from lucida.renderer.scene import View as SceneView
from lucida.renderer.system.atomic import check_writable

from .canvas import Target
from .capture import free_path
from .figure_choice import FigureChoice
from .figures import encoder
from .platform import Platform, start_platform
from .start import begin_scene, begin_session, kept
from .viewer import WindowRun

DEFAULT_PICTURE = Path("lucida.png")
LAID_OUT = 4  # frames until views have their places
SHOWN_IN = {"outside": (OUTSIDE, layout.OUTSIDE), "probe": (PROBE, PROBE)}  # view, layout


def run_viewer(
    scene_source: str | None = None,
    screenshot: Path | None = None,
    *,
    size: tuple[int, int] | None = None,
    view: SceneView | None = None,
    resolution: tuple[int, int] | None = None,
    change: Callable[[SceneView], SceneView] | None = None,
    fresh: bool = False,
    code: str = "",
    photograph: str = "",
    cameras: PoseSet | None = None,
) -> int:
    """Open the window on a scene. Return the exit status when it is closed.

    Without a scene, a view, a screenshot and `fresh`, the last session continues; a given scene or
    view becomes the session. screenshot: draw the whole window once, with both images complete,
    save it there as PNG, and return. Without a display the window is always drawn like this, into
    lucida.png, or lucida-2.png if that exists, and a line is printed. size: the window's (width,
    height). view: replaces the scene's own. resolution: both images' resolution; None to fit the
    window. change: applies the command line's other camera options. code: the absolute path of a
    Python file to run. photograph: the path of a picture to lay over the images. cameras: a set of
    cameras to show. Raises LucidaError.
    """
    if cameras is not None:
        scene_source, view = EMPTY_SCENE, view or cameras.view(0)
    goes_on = scene_source is None and view is None and change is None and screenshot is None
    if screenshot is not None:
        check_writable(screenshot)
    start = None if goes_on else begin_scene(scene_source, view, change)
    platform, picture = start_drawing(screenshot, "the window")
    if start is None:
        start = begin_session(fresh) if picture is None else begin_scene()
    elif picture is None:
        start = kept(start, fresh)
    if resolution is not None:
        start = replace(start, state=with_resolution(start.state, resolution))
    if code:
        opened = start.state.with_options(replace(start.state.options.your_code, file=stored(code)))
        start = replace(start, state=opened, code=code)
    if photograph:
        laid = with_photograph(start.state, photograph, shown=True, follows=False)
        start = replace(start, state=laid)
    if cameras is not None:
        seen = with_set(
            start.state, cameras, start.state.scene if view == cameras.view(0) else None
        )
        start = replace(start, state=with_set_framed(seen, cameras, None), poses=cameras)
    run = WindowRun(platform, start.state, size, picture is not None, start=start)
    return run.to_the_end(picture, tell=screenshot is None)


def start_drawing(screenshot: Path | None, what: str) -> tuple[Platform, Path | None]:
    """Return the platform, and the file of the picture that is drawn instead of opening a window.

    It is the screenshot's file; without a display, lucida.png, or lucida-2.png if that exists.
    what: a description of the picture. Raises LucidaError.
    """
    platform = start_platform(want_display=screenshot is None)
    if platform.has_display or screenshot is not None:
        return platform, screenshot
    picture = free_path(DEFAULT_PICTURE)
    check_writable(picture)
    print(f"lucida: no display ({platform.reason}): drawing {what} once, into {picture}")
    return platform, picture


def draw_figure(
    scene: Scene, view: SceneView, choice: FigureChoice, ending: str, marked: Pixel | None
) -> bytes:
    """Return the file of a figure that a window without a display shows.

    ending: the file name's ending. marked: the pixel to mark. Raises LucidaError.
    """
    width, height = choice.size
    state = AppState.for_scene(scene, view)
    state = with_resolution(state, (width // 2 if choice.what == "pair" else width, height))
    state = state.with_options(replace(state.options, marked=marked))
    run = WindowRun(start_platform(want_display=False), state, None, take_picture=True)
    run.ends_once_complete = False
    window, frames, quiet, content = run.window, 0, 0, b""

    def drawn(_: Target) -> None:
        nonlocal frames, quiet, content
        window.check()
        frames += 1
        if frames == LAID_OUT and choice.what in SHOWN_IN:
            window.show_in(*SHOWN_IN[choice.what])
        quiet = quiet + 1 if window.settled and frames > LAID_OUT else 0
        if quiet > LAID_OUT and not content:
            content = encoder(window, choice)(ending)
            run.params.app_shall_exit = True

    run.on_drawn = drawn
    run.run()
    return content
