"""The camera's numbers during editing: invalid values wait in a Draft until they are valid.

Pure. The state always holds a valid camera, the last valid one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError

from .basis import with_component

BASIS = ("u", "v", "w")


@dataclass(frozen=True)
class Draft:
    """Entered values that do not (yet) make a camera.

    camera: the valid one that is being edited.
    fields: entered values that are not in it, by name.
    error: the reason why they do not.
    base: the camera at the beginning of a drag. Orthonormal edits start from it, so that dragging
    back restores everything.
    """

    camera: Camera
    fields: tuple[tuple[str, Any], ...] = ()
    error: LucidaError | None = None
    base: Camera | None = None

    @classmethod
    def of(cls, camera: Camera) -> Draft:
        return cls(camera)

    def following(self, camera: Camera) -> Draft:
        """Return this draft if it still belongs to the camera, else a fresh one."""
        return self if camera is self.camera or camera == self.camera else Draft(camera)

    def value(self, name: str) -> Any:
        """Return the field's displayed value: what was entered, else the camera's."""
        return dict(self.fields).get(name, getattr(self.camera, name))

    def is_wrong(self, name: str) -> bool:
        """Return True if the error is about this field."""
        return self.error is not None and self.error.field == name

    def begun(self) -> Draft:
        """Return the draft at the start of a drag or typed entry."""
        return replace(self, base=self.camera)


def edit_component(
    state: AppState, draft: Draft, name: str, index: int, value: float
) -> tuple[AppState, Draft]:
    """Set component `index` of eye, u, v, w or viewport to `value`."""
    if name in BASIS and state.keep_orthonormal:
        try:
            base = draft.base or draft.camera
            camera = with_component(base, name, index, value)
        except LucidaError as error:
            return state, replace(draft, error=error)
        basis = {entry: getattr(camera, entry) for entry in BASIS}
        others = {k: v for k, v in draft.fields if k not in BASIS}
        return _edited(state, draft, basis, others)
    entered = list(draft.value(name))
    entered[index] = value
    return edit_field(state, draft, name, tuple(entered))


def edit_field(state: AppState, draft: Draft, name: str, value: Any) -> tuple[AppState, Draft]:
    """Set a field to `value`. If that makes no valid camera, the draft keeps it."""
    others = {k: v for k, v in draft.fields if k != name}
    return _edited(state, draft, {name: value}, others)


def _edited(
    state: AppState, draft: Draft, edit: dict[str, Any], waiting: dict[str, Any]
) -> tuple[AppState, Draft]:
    """Apply `edit` to the camera, with all waiting values if that is valid, else alone."""
    try:
        camera = replace(draft.camera, **waiting, **edit)
        return state.with_camera(camera), Draft(camera, base=draft.base)
    except LucidaError as error:
        wrong = error
    try:
        camera = replace(draft.camera, **edit)
    except LucidaError:
        return state, replace(draft, fields=tuple({**waiting, **edit}.items()), error=wrong)
    return state.with_camera(camera), Draft(camera, tuple(waiting.items()), wrong, draft.base)
