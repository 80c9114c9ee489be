"""The change of an undo step, in a few words: `Eye x: 3.4 to 7`."""

from __future__ import annotations

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene

from .app_state import AppState

SIDES = ("left", "right", "bottom", "top")


def change(before: AppState, after: AppState) -> str:
    """Return the difference of one state from the last, in words."""
    if after.step is not None and before.step != after.step:
        _, step, build = after.step
        return f"Lecture: step {step + 1}" + (f".{build + 1}" if build else "")
    if before.scene is not after.scene:
        return _scene(before.scene, after.scene)
    parts = _camera(before.camera, after.camera)
    if before.view.fit != after.view.fit:
        parts.append(f"Fit to the image's aspect ratio: {_on(after.view.fit)}")
    if before.keep_orthonormal != after.keep_orthonormal and not parts:
        parts.append(f"Keep orthonormal: {_on(after.keep_orthonormal)}")
    parts += _options(before, after)
    return ", ".join(parts[:3]) or "Nothing visible"


def _scene(before: Scene, after: Scene) -> str:
    """Return the name of the added, deleted or edited object, or of the scene if it is another."""
    old = {id(one): one.name for one in before.objects}
    new = {id(one): one.name for one in after.objects}
    gone = [name for key, name in old.items() if key not in new]
    come = [name for key, name in new.items() if key not in old]
    if before.name != after.name or max(len(gone), len(come)) > 1 or not before.objects:
        return f"Scene: {after.name or 'without a name'}"
    if come and gone:
        return f"Edit {come[0]}" if come == gone else f"Rename {gone[0]} to {come[0]}"
    if come or gone:
        return f"Add {come[0]}" if come else f"Delete {gone[0]}"
    return "Lights and background"


def _camera(before: Camera, after: Camera) -> list[str]:
    """Return the words for a changed camera: its number if one has changed, otherwise its parts."""
    if before == after:
        return []
    if before.projection != after.projection:
        return [f"{after.projection.capitalize()} projection"]
    if before.lens != after.lens:
        return [f"Lens: {after.lens.model if after.lens is not None else 'none'}"]
    old, new = _numbers(before), _numbers(after)
    changed = [name for name in old if old[name] != new[name]]
    parts = {name.split()[0] for name in changed}
    if len(changed) == 1:
        return [f"{changed[0]}: {_number(old[changed[0]])} to {_number(new[changed[0]])}"]
    if parts <= {"u", "v", "w"}:
        return ["Turn the camera"]
    return ["Viewport" if parts == {"Viewport"} else "Move the camera"]


def _numbers(camera: Camera) -> dict[str, float | None]:
    vectors = {"Eye": camera.eye, "u": camera.u, "v": camera.v, "w": camera.w}
    return {
        **{
            f"{name} {axis}": x
            for name in vectors
            for axis, x in zip("xyz", vectors[name], strict=True)
        },
        **{f"Viewport {side}": x for side, x in zip(SIDES, camera.viewport, strict=True)},
        "Distance d": camera.distance,
        "Near": camera.near,
        "Far": camera.far,
    }


def _options(before: AppState, after: AppState) -> list[str]:
    old, new = before.options, after.options
    words = []
    if old.marked != new.marked:
        pixel = new.marked
        words.append("Clear the mark" if pixel is None else f"Mark {new.indexing.text(pixel)}")
    if old.probe.pins != new.probe.pins:
        words.append("Pin a pixel" if len(new.probe.pins) > len(old.probe.pins) else "Remove pins")
    if old.images.resolution != (size := new.images.resolution):
        words.append(f"Resolution: {f'{size[0]} x {size[1]}' if size else 'fit to window'}")
    if old.images.samples != new.images.samples:
        words.append(f"Samples per pixel: {old.images.samples} to {new.images.samples}")
    if old.images.lens_enlargement != new.images.lens_enlargement:
        words.append(f"Lens: {new.images.lens_enlargement} texels per pixel")
    for name in ("shadows", "mirrors"):
        if (is_on := getattr(new, name)) != getattr(old, name):
            words.append(f"{name.capitalize()}: {_on(is_on)}")
    for name in ("bookmarks", "photograph", "poses"):
        if getattr(old, name) != getattr(new, name):
            words.append(name.capitalize())
    return words


def _number(value: float | None) -> str:
    return "off" if value is None else f"{value:.4g}"


def _on(is_on: bool) -> str:
    return "on" if is_on else "off"
