"""The actions of the camera: projection, presets, framing, copying and pasting.

Panels and menus share these names, keys and effects on the window. The cameras come from presets.py
and navigation.py, the texts from text.py and reader.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from imgui_bundle import imgui

from lucida.app.cameras.lens_choices import LENS_PRESETS, LensPreset
from lucida.app.cameras.meanings import Meaning, matrix_in, meanings
from lucida.app.cameras.presets import PRESETS, Preset, framed, look_at, preset_view
from lucida.app.cameras.reader import read_copied
from lucida.app.cameras.text import FORMS, Form, Subject, as_text
from lucida.app.state.app_state import AppState, is_orthonormal
from lucida.app.ui.action import Action, changing, choosing
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.navigation import switched_projection
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

SCENE_VIEW = "Scene's view"
SQUARE = (1, 1)  # an image before the first layout
LENS_OFF = "The lens is off: parallel rays pass through none. Ctrl+Z brings it back."


def with_its_basis(state: AppState) -> AppState:
    """Return the state with its orthonormal switch set to match the basis: presets turn it on and
    off.
    """
    return replace(state, keep_orthonormal=is_orthonormal(state.camera))


def switch_projection(window: Host) -> None:
    camera = switched_projection(window.state.camera, window.focus.center)
    _say_if_off(window, camera)
    window.travel(window.state.with_camera(camera))


def _say_if_off(window: Host, camera: Camera) -> None:
    """Show a message if parallel rays have taken the lens off."""
    if camera.is_parallel and window.state.camera.lens is not None:
        window.files.say(LENS_OFF)


def go_to_lens(window: Host, preset: LensPreset) -> None:
    """Move to a preset's lens; eye and basis stay."""
    width, height = image_size(window)
    camera = preset.of(window.state.camera, width / height)
    window.travel(window.state.with_camera(camera))


def take_lens_off(window: Host) -> None:
    """Move to a pinhole with the distance and the viewport that the scene came with."""
    own, now = window.state.scene.view.camera, window.state.camera
    camera = replace(now, lens=None, projection="perspective")
    if not own.is_parallel:
        camera = replace(camera, distance=own.distance, viewport=own.viewport)
    window.travel(window.state.with_camera(camera))


def go_home(window: Host) -> None:
    window.travel(window.state.with_view(window.state.scene.view))


def go_to_view(window: Host, view: View) -> None:
    """Move to a view from the scene's file, as an undo step."""
    window.travel(with_its_basis(window.state.with_view(view)))


def look_there(window: Host, target: Vector, up: Vector) -> None:
    """Turn the camera towards a point."""
    try:
        view = look_at(window.state.view, window.state.camera.eye, target, up)
    except LucidaError as error:
        window.files.message = str(error)
        return
    go_to_view(window, view)


def go_to_canonical(window: Host) -> None:
    """Move to the lecture's camera."""
    view = replace(window.state.view, camera=Camera.canonical())
    window.travel(window.state.with_view(view))


def go_to_preset(window: Host, preset: Preset) -> None:
    """Move to a preset, with the scene in the picture."""
    state, focus = window.state, window.focus
    width, height = image_size(window)
    try:
        view = preset_view(preset, state.view, focus.framed, focus.bounds, width / height)
    except LucidaError as error:
        window.files.message = str(error)
        return
    _say_if_off(window, view.camera)
    window.travel(with_its_basis(state.with_view(view)))


def frame_scene(window: Host) -> None:
    """Move the camera, without turning it, so that the scene fills the picture."""
    try:
        camera = framed(window.state.camera, window.focus.framed, window.focus.bounds)
    except LucidaError as error:
        window.files.message = str(error)
        return
    window.travel(window.state.with_camera(camera))


def image_size(window: Host) -> Size:
    """Return (width, height) of the images on screen."""
    return window.renderers.size if min(window.renderers.size) else SQUARE


def copy(window: Host, form: Form) -> None:
    """Copy the camera as text to the clipboard. If the form cannot hold it, report that and copy
    nothing.
    """
    state = window.state
    shown = window.renderers.camera(state)
    subject = Subject(state.view, shown, window.focus.bounds)
    try:
        text = as_text(form, subject)
    except LucidaError as error:
        window.files.message = f"Nothing was copied as {form}. {error}"
        return
    imgui.set_clipboard_text(text)
    window.files.say(f"The camera is on the clipboard: {form}.")


def clipboard_text() -> str:
    try:
        return imgui.get_clipboard_text() or ""
    except RuntimeError:  # the system has no clipboard, or no text in it
        return ""


def paste(window: Host) -> None:
    """Paste the camera from the clipboard. Ask for the meaning of a matrix without a name."""
    text = clipboard_text()
    try:
        copied = read_copied(text, window.state.view)
    except LucidaError as error:
        matrix, center = matrix_in(text), window.focus.center
        found = [] if matrix is None else meanings(matrix, window.state.view, center)
        if not found:
            window.files.message = str(error)
            return
        answers: dict[str, Callable[[], None]] = {
            meaning.words: partial(_take, window, meaning) for meaning in found
        }
        window.files.ask("What does the pasted matrix mean?", answers)
        return
    window.travel(with_its_basis(window.state.with_view(copied.view)))
    window.files.say(copied.said)


def _take(window: Host, meaning: Meaning) -> None:
    window.travel(with_its_basis(window.state.with_view(meaning.view)))
    window.files.say(f"The camera is the pasted matrix's: {meaning.words.splitlines()[0]}.")


def _to_preset(preset: Preset) -> Action:
    """Return the action of a preset, with its usual key in other programs of the field."""
    keys = {
        "Front": "Keypad 1", "Back": "Ctrl+Keypad 1", "Right": "Keypad 3", "Left": "Ctrl+Keypad 3",
        "Top": "Keypad 7", "Bottom": "Ctrl+Keypad 7", "Isometric": "Keypad 9",
    }.get(preset.name, "")  # fmt: skip
    return Action(
        "Camera/Presets",
        preset.name,
        partial(go_to_preset, preset=preset),
        keys,
        separated=preset.name in ("Isometric", "Cavalier"),
    )


def _to_lens(preset: LensPreset) -> Action:
    run = partial(go_to_lens, preset=preset)
    return Action("Camera/Lens", preset.name, run, is_on=lambda s: s.camera.lens == preset.lens)


CAMERA = (
    Action(
        "Camera",
        "Parallel projection",
        switch_projection,
        "P",
        is_on=lambda state: state.camera.is_parallel,
    ),
    Action(
        "Camera",
        "Keep orthonormal",
        changing(lambda state: state.with_keep_orthonormal(not state.keep_orthonormal)),
        "O",
        is_on=lambda state: state.keep_orthonormal,
    ),
    Action(
        "Camera",
        "Fit to the image's aspect ratio",
        changing(lambda state: state.with_fit(not state.view.fit)),
        is_on=lambda state: state.view.fit,
    ),
    Action(
        "Camera",
        SCENE_VIEW,
        go_home,
        "Home, H",
        separated=True,
    ),
    Action("Camera", "Canonical camera", go_to_canonical),
    Action(
        "Camera",
        "Aim at the object under the mouse",
        lambda window: window.focus_object(),
        "F",
    ),
    Action("Camera", "Frame the scene", frame_scene, "Shift+F"),
    *(_to_preset(preset) for preset in PRESETS),
    *(_to_lens(preset) for preset in LENS_PRESETS),
    Action(
        "Camera/Lens",
        "No lens",
        take_lens_off,
        is_on=lambda state: state.camera.lens is None,
        separated=True,
    ),
    choosing("Camera", "Animate camera changes", "preferences.reduced_motion", False, off=True),
)

EDIT = (
    Action(
        "Edit",
        "Copy camera",
        partial(copy, form=FORMS[0]),
        "Ctrl+Shift+C",
        separated=True,
    ),
    *(
        Action("Edit/Copy camera as", form[0].upper() + form[1:], partial(copy, form=form))
        for form in FORMS
    ),
    Action("Edit", "Paste camera", paste, "Ctrl+V"),
)
