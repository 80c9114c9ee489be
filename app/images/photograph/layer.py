"""The open photograph, for all views: read on a thread, held once. It costs nothing until used."""

from __future__ import annotations

from pathlib import Path

import moderngl

from lucida.app.images.photograph.laying import Laying
from lucida.app.images.photograph.model import Parts, covered, letterboxed, note, path_of, pixels_of
from lucida.app.images.photograph.reading import DecodedPhotograph, Size, decoded, without_lens
from lucida.app.images.placement import Placement
from lucida.app.images.renderers import Renderers
from lucida.app.images.shown import Picture
from lucida.app.state.app_state import AppState
from lucida.app.ui.background import Background
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError, describe

# The file, its size on screen in pixels, and the lens that is taken out of it.
Asked = tuple[Path, Size, View | None]
Answer = tuple[Asked, DecodedPhotograph | str]  # the photograph, or why there is none


class PhotographLayer:
    """problem: why there is no photograph, one line. note: a remark on it. file_size: the
    photograph's own (width, height); (0, 0) if unknown.
    """

    def __init__(self) -> None:
        self._gl: moderngl.Context | None = None
        self._work: Background[Answer] = Background("lucida-photograph")
        self._laying: Laying | None = None
        self._asked: Asked | None = None
        self._path: Path | None = None  # of the photograph on the GPU
        self._distorted: View | None = None  # the lens that is taken out of that
        self.problem = ""
        self.note = ""
        self.file_size: Size = (0, 0)

    def begin(self, context: moderngl.Context) -> None:
        """Prepare the layer."""
        self._gl = context

    @property
    def busy(self) -> bool:
        """True while a photograph is being read that a view still asks for."""
        return self._asked is not None and self._work.busy

    def follow(self, both: Renderers, state: AppState) -> bool:
        """Return True if there is a photograph to show. Call in each frame in which a view would
        show it.
        """
        path = path_of(state)
        if path is None or self._gl is None or not min(both.size):
            self._forget()
            return False
        distorted = state.options.photograph.distorted
        asked = path, pixels_of(self._parts(both, state), both.size), distorted
        if self._laying is None:
            self._laying = Laying(self._gl)
        outcome = self._work.poll()
        if outcome is not None and outcome.value is not None:
            self._take(*outcome.value)
        if asked != self._asked:
            self._asked, self.problem = asked, ""
            self._work.submit(lambda: _answer(asked))
        if self._path != path or self._distorted != distorted:
            return False
        has_bars = self._parts(both, state) != covered(state.camera, both.camera(state))
        self.note = note(path.name, self.file_size, has_bars)
        return True

    def over(
        self,
        both: Renderers,
        state: AppState,
        name: str,
        picture: Picture | None,
        placement: Placement,
    ) -> Picture | None:
        """Return a picture of one of the images with the photograph as the state says. Call
        follow() first.

        name: of the view.
        """
        options = state.options.photograph
        if picture is None or not options.shown or not options.opacity:
            return picture
        assert self._laying is not None
        parts = self._parts(both, state)
        try:
            return self._laying.laid(name, picture, placement, parts, options.opacity)
        except (LucidaError, moderngl.Error) as error:  # shown in the view, which goes on
            self.problem = describe(error)
            return picture

    def end(self) -> None:
        self._work.close()
        self._forget()
        if self._laying is not None:
            self._laying.release()
        self._laying = self._gl = None

    def _parts(self, both: Renderers, state: AppState) -> Parts:
        """Return the part of the images that the photograph covers, as far as its size is known.

        A camera from a file may have pixels that are not square: its own image's shape counts.
        """
        parts = covered(state.camera, both.camera(state))
        known = self._path is not None and self._path == path_of(state)
        known = known and self._distorted == state.options.photograph.distorted
        shape = state.view.own_size or pixels_of(parts, both.size)
        return letterboxed(parts, shape, self.file_size) if known else parts

    def _take(self, asked: Asked, answer: DecodedPhotograph | str) -> None:
        assert self._laying is not None
        if self._asked is None or asked[::2] != self._asked[::2]:
            return  # another one is wanted by now
        self._path, self.problem = None, ""
        if isinstance(answer, str):
            self.problem = answer
            self._laying.take(None)
            return
        try:
            self._laying.take(answer.pixels)
        except LucidaError as error:
            self.problem = describe(error)
            return
        self._path, self.file_size, self._distorted = asked[0], answer.size, asked[2]

    def _forget(self) -> None:
        """Release the photograph's memory."""
        if self._asked is None:
            return
        self._asked = self._path = None
        self.problem = self.note = ""
        self.file_size = (0, 0)
        if self._laying is not None:
            self._laying.take(None)


def _answer(asked: Asked) -> Answer:
    try:
        path, size, distorted = asked
        if distorted is None:
            return asked, decoded(path, size)
        return asked, without_lens(decoded(path, distorted.own_size or size), distorted)
    except LucidaError as error:
        return asked, describe(error)
