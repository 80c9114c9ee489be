"""The window's state as one immutable value, and the list of such values that undo walks.

Pure. Panels take a state and return a new one (dataclasses.replace); the viewer compares old and
new.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field, replace

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene, View

from .bounds import OptionPart, clamped
from .options import Options
from .options.shared import ImageOptions, Pixel, Preferences

MOST_UNDO_STEPS = 500
ORTHONORMAL = 1e-6  # the largest deviation of a dot product or length
# The options that undo restores, in addition to the resolution and the selection.
UNDONE = (
    *("marked", "marked_size", "probe", "shadows", "mirrors"),
    *("bookmarks", "photograph", "poses"),
)


@dataclass(frozen=True)
class AppState:
    """Everything that the window shows. Scenes are compared by identity.

    keep_orthonormal: True if edits of u, v or w keep the basis orthonormal. options: see
    app/state/options; the properties below name its parts. step: the source of the lecture that
    shows the state, and the numbers of the step and its build, from 0; None outside lectures.
    """

    scene: Scene
    view: View
    keep_orthonormal: bool
    options: Options = field(default_factory=Options)
    step: tuple[str, int, int] | None = None

    @classmethod
    def for_scene(cls, scene: Scene, view: View | None = None) -> AppState:
        """Return the state of a scene, seen by its own view or by `view`."""
        view = scene.view if view is None else view
        return cls(scene, view, keep_orthonormal=is_orthonormal(view.camera))

    @property
    def camera(self) -> Camera:
        """The camera as the user edits it; view.for_size() returns the one to draw with."""
        return self.view.camera

    @property
    def images(self) -> ImageOptions:
        return self.options.images

    @property
    def preferences(self) -> Preferences:
        return self.options.preferences

    @property
    def marked(self) -> Pixel | None:
        return self.options.marked

    @property
    def has_effects(self) -> bool:
        """True if the ray image has shadows or mirrors."""
        return self.options.shadows or self.options.mirrors

    def with_options(self, *parts: Options | OptionPart) -> AppState:
        """Return the state with other parts of its options, each within its bounds.

        A part comes from replace(), as in with_options(replace(state.images, exposure_ev=1.0)).
        A new mark has no image size yet.
        """
        options = self.options.with_parts(*parts)
        if options.marked != self.marked and options.marked_size == self.options.marked_size:
            options = replace(options, marked_size=None)
        return replace(self, options=clamped(options))

    def with_camera(self, camera: Camera) -> AppState:
        """Return the state with another camera; the same object if nothing changes."""
        if camera == self.camera:
            return self
        return replace(self, view=replace(self.view, camera=camera))

    def with_view(self, view: View) -> AppState:
        """Return the state with another view. A skewed basis turns keep_orthonormal off."""
        keep = self.keep_orthonormal and is_orthonormal(view.camera)
        return replace(self, view=view, keep_orthonormal=keep)

    def with_scene(self, scene: Scene, view: View | None = None) -> AppState:
        """Return the state with another scene, seen by its own view or by `view`."""
        state = replace(self, scene=scene, keep_orthonormal=True)
        return state.with_view(scene.view if view is None else view)

    def undone_in(self, present: AppState) -> AppState:
        """Return this earlier state as undo restores it: with its own camera, scene, marks and
        UNDONE options, but the present theme, display and other options.
        """
        mine, options = self.options, present.options
        kept = {name: getattr(mine, name) for name in UNDONE}
        images = mine.images.displayed_as(options.images)
        objects = replace(options.objects, chosen=mine.objects.chosen)
        return replace(self, options=replace(options, images=images, objects=objects, **kept))

    def with_fit(self, fit: bool) -> AppState:
        """Return the state with this switch. Turning it off discards the camera's image size."""
        return replace(
            self, view=replace(self.view, fit=fit, given=self.view.given if fit else None)
        )

    def with_keep_orthonormal(self, keep: bool) -> AppState:
        """Return the state with this switch. Turning it on makes the basis orthonormal at once."""
        state = replace(self, keep_orthonormal=keep)
        if keep and not is_orthonormal(self.camera):
            return state.with_camera(self.camera.orthonormalized())
        return state


@dataclass(frozen=True)
class History:
    """A present state with the ones before and after it.

    Undo covers the camera, the scene and marks: see AppState.undone_in(). A change of anything else
    is not a step. gesture: a key of the last change's drag; changes of one gesture are one step.
    """

    present: AppState
    past: tuple[AppState, ...] = ()
    future: tuple[AppState, ...] = ()
    gesture: Hashable = None

    def change(self, state: AppState, gesture: Hashable = None) -> History:
        """Return the history after a change.

        gesture: equal to the last change's for the same drag; None for a step of its own.
        """
        if self._again(state) == self.present:
            return replace(self, present=state)
        if gesture is not None and gesture == self.gesture and self.past:
            if self._again(self.past[-1]) == self._again(state):  # back at the start: no step
                return History(state, self.past[:-1])
            return replace(self, present=state, future=())
        past = (*self.past, self.present)[-MOST_UNDO_STEPS:]
        return History(state, past, (), gesture)

    def amended(self, state: AppState) -> History:
        """Return the history with another present and no new step, because the user did not cause
        the change.
        """
        return self if state == self.present else replace(self, present=state)

    def unclicked(self, press: Hashable) -> History:
        """Return the history without the last step if that has this press's gesture and only sets
        or clears the mark, because the click was the first of a double click.
        """
        if not self.past or self.gesture != press:
            return self
        before = self.past[-1]
        shared = self.present.options
        again = self._again(before)
        mark = replace(again.options, marked=shared.marked, marked_size=shared.marked_size)
        same = replace(again, options=mark) == self.present
        return History(again, self.past[:-1]) if same else self

    def undo(self) -> History:
        """Return the history one step back; the same object at the beginning."""
        if not self.past:
            return self
        return History(self._again(self.past[-1]), self.past[:-1], (self.present, *self.future))

    def redo(self) -> History:
        """Return the history one step forward; the same object at the end."""
        if not self.future:
            return self
        return History(self._again(self.future[0]), (*self.past, self.present), self.future[1:])

    def _again(self, state: AppState) -> AppState:
        """Return undone_in() of a state. A state of another lecture step keeps its own options,
        except for the preferences.
        """
        if state.step != self.present.step:
            preferences = self.present.preferences
            return replace(state, options=replace(state.options, preferences=preferences))
        return state.undone_in(self.present)


def is_orthonormal(camera: Camera) -> bool:
    """Return True if u, v, w are of length 1 and at right angles, of either handedness."""
    basis = camera.basis
    gram = basis.T @ basis
    return bool(abs(gram - [[1, 0, 0], [0, 1, 0], [0, 0, 1]]).max() < ORTHONORMAL)
