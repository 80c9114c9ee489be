"""The view "Film": the settings of a film, a preview of its path, and the film on its way.

The path and the camera of one frame are drawn in the outside view; the window's own camera stays.
"""

from __future__ import annotations

import time
from dataclasses import asdict, replace
from pathlib import Path

import moderngl
import numpy as np

from app.filming import model
from app.filming.making import Making
from app.filming.options import FilmingOptions
from app.filming.panel import Shown, panel
from app.films.key_file import load_keys
from app.films.order import Order
from app.films.paths import Key, Way
from app.host.view import DockedView, Host
from app.outside.view import OutsideView
from app.poses.model import PoseSet
from app.poses.view import PosesView
from app.storage.paths import restored, stored
from app.widgets.background import Background
from app.widgets.uploads import Uploads
from renderer.camera import Camera, Size
from renderer.errors import LucidaError, describe
from renderer.images import to_srgb8
from renderer.memo import Memo

FILM = "Film"
PREVIEW_PX = 640  # the width of the preview's frame
PLACE = "Film"  # for the rasterizer's textures
FRAME = "frame"


class FilmView(DockedView):
    """The view "Film". making: the film on its way."""

    name = FILM
    title = "Film"

    def __init__(self, outside: OutsideView, poses: PosesView) -> None:
        self._outside, self._poses = outside, poses
        self._previewing: Background[tuple[Camera, ...]] = Background("lucida-film-path")
        self._uploads: Uploads | None = None
        self._cameras: tuple[Camera, ...] = ()
        self._problem = ""  # of the path
        self._at = 0.0  # the scrubber's place, 0 to 1
        self._began: tuple[float, float] | None = None  # while it plays: the time and the place
        self._drawn: object = None
        self._loaded = Memo(_loaded)
        self._photographs = Memo(_photographs)
        self._items = Memo(model.drawn_path)
        self._around = Memo(model.in_sight)
        self._seen = False
        self.making = Making()

    @property
    def settled(self) -> bool:
        is_played = self._seen and (self._previewing.busy or self._began is not None)
        return not (is_played or self.making.busy)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)

    def end(self) -> None:
        self.making.close()
        self._previewing.close()
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        self._tell(host)
        if self._seen:
            self._seen, self._began = False, None
            self._outside.show(FILM, ())

    def draw(self, host: Host) -> None:
        assert self._uploads is not None
        self._uploads.begin_frame()
        self._seen = True
        self._tell(host)
        options = host.state.of(FilmingOptions)
        keys, problem = self._keys(host, options)
        way = model.way_of(options, host.state.view, keys)
        cameras = () if problem else self._follow(host, options, way)
        problem = problem or self._problem
        self._play(host, options)
        number = round(self._at * (options.count - 1))
        if cameras and not problem:
            here = round(self._at * (len(cameras) - 1))
            self._picture(host, cameras[here], options.size)
            scene = host.state.scene
            items = self._items(cameras, here, keys, options.size, scene)
            self._outside.show(FILM, items, around=self._around(cameras, scene))
        else:
            self._outside.show(FILM, ())
        images = host.renderers.size
        progress = None
        if self.making.busy:
            made = self.making
            progress = made.part, model.left_text(made.part, made.first, made.time_s)
        shown = Shown(
            problem,
            self._uploads.get(FRAME) if cameras else None,
            number,
            options.count,
            len(keys),
            self._began is not None,
            images,
            progress,
        )
        changed, moved_to, wish = panel(options, shown, host.fonts)
        if changed != options:  # no step of undo: nothing of the scene or its images changes
            host.amend(host.state.with_options(filming=asdict(changed)))
        if moved_to != number:
            self._at, self._began = moved_to / max(1, options.count - 1), None
        if wish == "play":
            self._toggle(host)
        elif wish == "open":
            self._open_keys(host)
        elif wish == "save":
            self._ask_name(host, changed, way)
        elif wish == "cancel":
            self.making.cancel()

    # The path.

    def _keys(self, host: Host, options: FilmingOptions) -> tuple[tuple[Key, ...], str]:
        """Return the key cameras of the path, and why there is none."""
        try:
            if options.path == "bookmarks":
                return model.bookmark_keys(host.state.options.bookmarks, options.timing), ""
            if options.path == "file":
                path = Path(restored(options.file))
                if not options.file:
                    return (), "No key file is open. A file of bookmarks is one: File menu."
                return self._loaded(path, path.stat().st_mtime_ns)
            if options.path == "photographs":
                poses = self._poses.poses
                if poses is None:
                    return (), "No set of cameras is open: open one in the view Poses."
                return self._photographs(poses), ""
        except OSError as error:
            return (), f"{options.file}: {error.strerror}"
        except LucidaError as error:
            return (), describe(error)
        return (), ""

    def _follow(self, host: Host, options: FilmingOptions, way: Way) -> tuple[Camera, ...]:
        """Return the cameras of the preview; those of the last path until they are there."""
        self._previewing.ask(model.previewed, way, host.state.scene, options.size, options.count)
        outcome = self._previewing.poll()
        if outcome is not None:
            self._cameras = outcome.value or ()
            self._problem = "" if outcome.error is None else describe(outcome.error)
        return self._cameras

    def _open_keys(self, host: Host) -> None:
        def opened(paths: list[str]) -> None:
            chosen = {"path": "file", "file": stored(str(Path(paths[0]).absolute()))}
            host.amend(host.state.with_options(filming=chosen))

        host.files.ask_open("Open key cameras", "Key cameras", (".toml",), opened)

    # The preview.

    def _toggle(self, host: Host) -> None:
        if self._began is not None:
            self._began = None
            return
        self._at = 0.0 if self._at >= 1 else self._at
        self._began = time.monotonic(), self._at
        host.animate()

    def _play(self, host: Host, options: FilmingOptions) -> None:
        if self._began is None:
            return
        began_s, start = self._began
        self._at = start + (time.monotonic() - began_s) / options.seconds
        if self._at >= 1 or not host.moves:
            self._at, self._began = min(self._at, 1.0), None
        host.animate()

    def _picture(self, host: Host, camera: Camera, size: Size) -> None:
        """Draw the frame at the scrubber, if it is another one."""
        assert self._uploads is not None
        request, textures = host.renderers.request(host.state), host.renderers.textures
        if request is None or textures is None:
            return
        width = min(PREVIEW_PX, PREVIEW_PX * size[0] // size[1])
        drawn = replace(request, camera=camera, size=(width, max(1, width * size[1] // size[0])))
        key = drawn, host.state.images.exposure_ev
        if key == self._drawn:
            return
        self._drawn = key
        try:
            texture = textures.rasterizer.draw(drawn, PLACE).color
            light = np.frombuffer(texture.read(), np.float32).reshape(*drawn.size[::-1], 4)
            self._uploads.put(FRAME, to_srgb8(light[..., :3], host.state.images.exposure_ev))
        except LucidaError:  # the images tell what fails
            self._uploads.drop(FRAME)

    # The film.

    def _ask_name(self, host: Host, options: FilmingOptions, way: Way) -> None:
        state = host.state
        look = model.look_of(options, state.images.exposure_ev, state.images.lens_enlargement)

        def named(path: str) -> None:
            order = Order(
                Path(path), state.scene, way, look, options.size, options.count, options.fps
            )
            try:
                self.making.begin(order)
            except LucidaError as error:
                host.files.message = describe(error)

        words = "Folder" if not options.form else f"Film {options.form}"
        name = f"film{options.form}"
        host.files.ask_name("Save the film", name, (words, options.form), named)

    def _tell(self, host: Host) -> None:
        """Say how the film ended."""
        told = self.making.poll()
        if told is None:
            return
        if told[1]:
            host.files.say(told[0])
        else:
            host.files.message = told[0]


def _loaded(path: Path, _changed_ns: int) -> tuple[tuple[Key, ...], str]:
    """Return the keys in a file, or why there are none."""
    try:
        return tuple(load_keys(path)), ""
    except LucidaError as error:
        return (), describe(error)


def _photographs(poses: PoseSet) -> tuple[Key, ...]:
    return tuple(Key(poses.view(n), 1.0, "constant") for n in range(len(poses.names)))
