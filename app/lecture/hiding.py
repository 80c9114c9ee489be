"""An exercise that is answered in the scene: put one object where it hides another one.

Visible pixels are counted in id images, which the caller draws.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lucida.app.state.kept_lecture import Judgement
from lucida.renderer.camera.camera import Camera
from lucida.renderer.editing.changing import Item, fields_of, set_field
from lucida.renderer.editing.moving import bounds_of, shift
from lucida.renderer.editing.objects import hide
from lucida.renderer.editing.outline import OutlineRow, outline
from lucida.renderer.files.reading import suggestion
from lucida.renderer.scene.material import vector
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.errors import LucidaError

from .text import escaped

Ids = NDArray[np.int32]

ROUNDED = 1e-3  # of a size: handles compute in float32
PLACE = ("center", "translate", "rotate_deg")  # fields of the moved object that may change


@dataclass(frozen=True, eq=False)
class HideExercise:
    """Put an object where it hides another one from the step's camera.

    scene, view: the step's.
    moved, hidden: the objects' names in that scene.
    at_most: the largest part of the hidden object's pixels that may still show it.
    answer: a position of the object's middle that solves the exercise.
    """

    question: str
    scene: Scene
    view: View
    moved: str
    hidden: str
    answer: tuple[float, float, float]
    at_most: float = 0.02

    def __post_init__(self) -> None:
        """Raise LucidaError if the scene has no such objects."""
        names = [row.shown for row in _objects(self.scene)]
        for field, name in (("object", self.moved), ("hidden", self.hidden)):
            if name not in names:
                raise LucidaError(
                    field, f"{name[:40]!r} is unknown", suggestion(name, dict.fromkeys(names))
                )
            if names.count(name) > 1:
                remedy = "give each a name of its own"
                raise LucidaError(field, f"{names.count(name)} objects are called {name!r}", remedy)
            row = _row(self.scene, name)
            if row.hidden:
                raise LucidaError(field, f"{name!r} is hidden in the scene", "show it there")
            if field == "object" and row.locked:
                raise LucidaError(field, f"{name!r} is locked in the scene", "unlock it there")
        if self.moved == self.hidden:
            raise LucidaError("hidden", "is the object itself", "name another one")
        object.__setattr__(self, "answer", vector("answer", self.answer))

    @cached_property
    def item(self) -> Item:
        """The object to move, in the step's scene."""
        return _item(self.scene, self.moved)

    def ids(self, name: str) -> tuple[int, int]:
        """Return the first id of an object of the step's scene, and the one after the last."""
        ids = _row(self.scene, name).ids
        return ids.start, ids.stop

    def middle(self, name: str) -> NDArray[np.float64]:
        """Return the middle of an object of the step's scene."""
        return _middle(self.scene, _item(self.scene, name))

    @cached_property
    def without(self) -> Scene:
        """The step's scene without that object; ids are unchanged."""
        return hide(self.scene, [self.item])

    def camera_moved(self, camera: Camera, size: tuple[int, int]) -> bool:
        """Return True if an image's camera is not the step's."""
        return camera != self.view.for_size(size)

    def pixels(self, scene: Scene, ids: Ids) -> int:
        """Count the pixels of an image of that scene that show the object to hide."""
        return _count(ids, _row(scene, self.hidden))

    def check(self, scene: Scene, ids: Ids, alone: int) -> Judgement:
        """Return the verdict on an image from the step's camera.

        scene: the scene of the image, as edited.
        ids: (height, width).
        alone: pixels() in an image of the same size without the object.
        """
        said = self.told
        if changed := self._changed(scene):
            return Judgement(False, said[changed])
        if not alone:
            return Judgement(False, said["nowhere"])
        moved = _count(ids, _row(scene, self.moved))
        if moved in (0, ids.size):
            return Judgement(False, said["fills" if moved else "gone"])
        part = self.pixels(scene, ids) / alone
        if part <= self.at_most:
            return Judgement(True, said["none" if part == 0 else "right"])
        text = self._seen(part)
        return Judgement(False, f"{text} {said['behind']}" if self._is_behind(scene) else text)

    def solved(self, scene: Scene) -> Scene:
        """Return the scene with the object at the answer, rotated as it was. Raises LucidaError if
        the object was deleted.
        """
        item = _item(scene, self.moved)
        if "rotate_deg" in (was := _fields(self.scene, self.item)):
            scene = set_field(scene, [item], "rotate_deg", was["rotate_deg"])
        return shift(scene, [item], np.asarray(self.answer) - _middle(scene, item))

    def solution(self) -> str:
        """Return a place for the object, as a lecture's text."""
        x, y, z = self.answer
        return (
            f"On the way from the eye to the {escaped(self.hidden)}, and near enough to be large:"
            f" the middle of the {escaped(self.moved)} at `({x:g}, {y:g}, {z:g})`."
        )

    def _seen(self, part: float) -> str:
        return f"{percent(part)} of the {escaped(self.hidden)} can still be seen."

    @cached_property
    def told(self) -> dict[str, str]:
        """The replies, by the result of a move."""
        moved, hidden = escaped(self.moved), escaped(self.hidden)
        return {
            "camera": "The camera has moved. Only its first position counts: press Ctrl+Z.",
            "changed": f"Move only the {moved}; something else has changed, too.",
            "size": f"Move the {moved}, but keep its shape and size.",
            "nowhere": f"The {hidden} is not in the picture, even without the {moved}.",
            "fills": f"The {moved} fills the whole picture: the eye is inside it, or nearly so.",
            "gone": f"The {moved} is not in the picture.",
            "behind": f"The {moved} is farther away: the closest hit is the {hidden}.",
            "none": f"Correct: at each pixel of the {hidden}, the closest hit is now the {moved}.",
            "right": f"Correct: hardly a pixel shows the {hidden}; the {moved} is hit first.",
        }

    @property
    def when_moved(self) -> Judgement:
        """The reply if the camera is not the step's."""
        return Judgement(False, self.told["camera"])

    def _changed(self, scene: Scene) -> str:
        """Return the reply for a change of anything but the object's place; "" for none."""
        mine, theirs = _tables(self.scene), _tables(scene)
        (before,), now = mine.pop(self.moved), theirs.pop(self.moved, [])
        # An added object whose name exists already is a change, too.
        if len(now) != 1 or _sorted(mine) != _sorted(theirs):
            return "changed"
        (after,) = now
        if after["hidden"]:
            return "gone"
        for field in (*PLACE, "material"):
            before.pop(field, None)
            after.pop(field, None)
        same = before.keys() == after.keys() and all(_alike(before[k], after[k]) for k in before)
        return "" if same else "size"

    def _is_behind(self, scene: Scene) -> bool:
        """Return True if the object's centre is farther along the camera's view than the
        other's.
        """
        ahead = -np.asarray(self.view.camera.w)
        moved, other = (_middle(scene, _item(scene, n)) for n in (self.moved, self.hidden))
        return bool((moved - other) @ ahead > 0)


def _alike(before: Any, now: Any) -> bool:
    """Return True if a field is unchanged, except for the rounding of handles."""
    if isinstance(before, str | bool) or isinstance(now, str | bool) or None in (before, now):
        return bool(before == now)
    return bool(np.allclose(before, now, rtol=ROUNDED, atol=0.0))


def percent(part: float) -> str:
    """Return a fraction as a percentage; small ones get one more decimal."""
    return f"{100 * part:.0f} %" if part >= 0.0995 else f"{100 * part:.1f} %"


def _objects(scene: Scene) -> list[OutlineRow]:
    return [row for row in outline(scene) if not row.is_light]


def _row(scene: Scene, name: str) -> OutlineRow:
    found = [row for row in _objects(scene) if row.shown == name]
    if not found:
        raise LucidaError("", f"the scene has no {name!r} any more", "go back to the step")
    return found[0]


def _item(scene: Scene, name: str) -> Item:
    item = _row(scene, name).item
    assert item is not None  # scenes of files can be edited
    return item


def _tables(scene: Scene) -> dict[str, list[dict[str, Any]]]:
    """Return all fields of the objects, by their shown names."""
    found: dict[str, list[dict[str, Any]]] = {}
    for row in _objects(scene):
        assert row.item is not None
        found.setdefault(row.shown, []).append(_fields(scene, row.item))
    return found


def _sorted(tables: dict[str, list[dict[str, Any]]]) -> dict[str, list[str]]:
    """Sort the objects of each name, so that their order does not matter."""
    return {name: sorted(map(repr, those)) for name, those in tables.items()}


def _fields(scene: Scene, item: Item) -> dict[str, Any]:
    return msgspec.structs.asdict(fields_of(scene, item))


def _count(ids: Ids, row: OutlineRow) -> int:
    return int(np.count_nonzero((ids >= row.ids.start) & (ids < row.ids.stop)))


def _middle(scene: Scene, item: Item) -> NDArray[np.float64]:
    bounds = bounds_of(scene, [item])
    assert bounds is not None
    return bounds.mean(axis=0)
