"""The detective: a matrix of unknown meaning, and a picture of the scene for each of its readings.

The view requests pictures from a thread, and applies the selection. readings.py has the readings,
ranking.py their order, panel.py their look.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import moderngl
from imgui_bundle import imgui

from app.camera_panel.actions import clipboard_text, with_its_basis
from app.detective import example, model, ranking
from app.detective.model import Findings, Light, MatrixCase
from app.detective.options import MOST_CHARACTERS, DetectiveOptions
from app.detective.panel import MatrixWish, ReadingsShown, code_of, panel
from app.detective.printed import pasted
from app.detective.ranking import Ranked
from app.detective.readings import up_of
from app.host.view import DockedView, Host
from app.images.ray_pictures import RayPictures
from app.widgets.uploads import Uploads
from renderer.camera import Camera
from renderer.errors import LucidaError, describe
from renderer.focus import Focus
from renderer.images import to_srgb8
from renderer.scene.model import Scene

DETECTIVE = "Detective"


@dataclass(frozen=True, eq=False)
class _Made:
    """The pictures of the readings' cameras. of: the key of the request."""

    of: Any
    lights: tuple[Light, ...]


class DetectiveView(DockedView):
    """The detective. findings: those shown; None before the first."""

    name = DETECTIVE
    title = "Detective"

    def __init__(self) -> None:
        self._painter: RayPictures[_Made] | None = None
        self._uploads: Uploads | None = None
        self._uploaded: Any = None
        self._found_of: tuple[MatrixCase, Scene] | None = None
        self._asked: MatrixWish = ""
        self._examples = 0
        self._example: Camera | None = None  # that the text is the matrix of
        self._at: int | None = None  # the picture that the keyboard is at
        self._seen = False
        self.findings: Findings | None = None

    @property
    def settled(self) -> bool:
        if not self._seen or self._painter is None:
            return True
        return not (self._painter.busy or self._asked)

    def ask(self, wish: MatrixWish) -> None:
        """Ask for what a button would do, in the next frame."""
        self._asked = wish

    def takes(self, host: Host, text: str) -> bool:
        try:
            pasted(text)
        except LucidaError:
            return False
        self.paste(host, text)
        return True

    def paste(self, host: Host, text: str) -> None:
        """Use a pasted text, whatever it contains."""
        self._example, self._at = None, 0
        changes = {"text": text[:MOST_CHARACTERS].strip(), "chosen": ""}
        host.change(host.state.with_options(detective=changes))

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._painter = RayPictures("lucida-detective", host.animate)
        self._uploads = Uploads(context)

    def end(self) -> None:
        if self._painter is not None:
            self._painter.close()
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        if not self._seen or self._painter is None:
            return
        self._painter.forget()
        self._seen, self._asked = False, ""
        self._uploaded, self._found_of, self.findings = None, None, None

    def draw(self, host: Host) -> None:
        assert self._uploads is not None
        self._uploads.begin_frame()
        self._seen = True
        host.renderers.need_size(host.state.images)
        options = host.state.of(DetectiveOptions)
        findings = self._look(host)
        answer = panel(options, findings, self._shown(host, findings), host.fonts)
        self._at = answer.at
        if answer.options != options:
            host.apply(host.state.with_options(detective=asdict(answer.options)))
        if answer.chosen is not None:
            self._choose(host, answer.chosen)
        wish, self._asked = self._asked or answer.wish, ""
        if wish == "paste":
            self.paste(host, clipboard_text())
        elif wish == "example":
            self._set_example(host)
        elif wish == "copy":
            chosen = findings.named(options.chosen)
            if chosen is not None:
                imgui.set_clipboard_text(code_of(findings, chosen))
                host.files.say("The Python lines are in the clipboard.")

    # From the state to the pictures.

    def _look(self, host: Host) -> Findings:
        case, scene = model.case_of(host.state, host.renderers.size), host.state.scene
        known = self._found_of
        if self.findings is None or known is None or known[0] != case or known[1] is not scene:
            self._found_of = (case, scene)
            focus: Focus = host.focus
            self.findings = model.found_in(case, focus)
        return self.findings

    def _shown(self, host: Host, findings: Findings) -> ReadingsShown:
        """Return the pictures of the readings. Pictures of other readings are not shown in their
        place.
        """
        assert self._painter is not None and self._uploads is not None
        if not findings.shown:
            self._painter.forget()
            return ReadingsShown(lambda number: None)
        state, size = host.state, findings.case.size
        cameras = tuple(one.reading.view.for_size(size) for one in findings.shown)
        key = (cameras, size)
        made = self._painter.follow(
            key,
            state.scene,
            host.renderers.live,
            lambda painter: _Made(key, model.pictures(painter, cameras, size)),
        )
        error, note = self._painter.error, ""
        if error is not None:
            note = describe(error)
        is_there = made is not None and made.of == key
        if made is not None and is_there and self._uploaded != (made, state.images.exposure_ev):
            self._uploaded = (made, state.images.exposure_ev)
            try:
                for number, light in enumerate(made.lights):
                    self._uploads.put(f"{number}", to_srgb8(light, state.images.exposure_ev))
            except LucidaError as problem:  # no memory for the textures
                note = describe(problem)
        if not is_there and not note:
            note = host.renderers.preparing()
        here = frozenset(
            number
            for number, one in enumerate(findings.shown)
            if model.is_here(one, state.view, size)
        )
        uploads = self._uploads

        def texture(number: int) -> moderngl.Texture | None:
            return uploads.get(f"{number}") if is_there else None

        return ReadingsShown(texture, here, note, self._at)

    # The requests.

    def _choose(self, host: Host, one: Ranked) -> None:
        """Set the camera, as one undo step. The written form is not part of it."""
        name = ranking.name(one.reading.convention, up_of(host.state.scene.view))
        if self._example is not None and self._example_is_it(host, one):
            host.files.say(f"Correct: it is {name}.")
        elif self._example is not None:
            host.files.say("No: that is not the camera that the matrix was made of.")
        host.amend(host.state.with_options(detective={"chosen": name}))
        host.travel(with_its_basis(host.state.with_view(one.reading.view)))

    def _example_is_it(self, host: Host, one: Ranked) -> bool:
        camera = one.reading.view.camera
        made_of = self._example
        assert made_of is not None
        ways = zip(
            (*camera.eye, *camera.u, *camera.v, *camera.w),
            (*made_of.eye, *made_of.u, *made_of.v, *made_of.w),
            strict=True,
        )
        reach = 1.0 + max(map(abs, made_of.eye))
        return all(abs(a - b) < 1e-6 * reach for a, b in ways)

    def _set_example(self, host: Host) -> None:
        camera, up = host.state.camera.orthonormalized(), up_of(host.state.scene.view)
        self._examples += 1
        convention = example.drawn(self._examples)
        text = example.printed_matrix(example.matrix_of(camera, convention, up))
        self.paste(host, text)
        self._example = camera
