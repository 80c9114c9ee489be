"""The switches of the outside view: names, tooltips, and the option that each changes.

The words are the same in the view, the menu and the palette.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from lucida.app.state.options.outside import STAGES, OutsideOptions

BUNDLE = (4, 5)  # rows and columns of the bundle when it is switched on
AXIS_NAMES = {
    "x": "from the right (+x)",
    "-x": "from the left (-x)",
    "y": "from above (+y)",
    "-y": "from below (-y)",
    "z": "from the front (+z)",
    "-z": "from behind (-z)",
}


@dataclass(frozen=True)
class Switch:
    """A field of OutsideOptions, its name, its tooltip."""

    field: str
    name: str
    tip: str


SWITCHES = (
    Switch("basis", "basis", "the basis vectors u, v, w at the eye, at their true lengths"),
    Switch("image", "image", "the live image on the image plane"),
    Switch("grid", "grid", "the pixel grid on the image plane"),
    Switch("volume", "volume", "the view volume: what the camera can see"),
    Switch("ray", "ray", "the viewing ray of the marked pixel, or the one under the mouse"),
    Switch("formula", "formula", "the marked pixel's ray, term by term: -dw, uu, vv"),
    Switch("bundle", "bundle", "viewing rays spread over the image"),
)

HANDLES = (
    ("move", "move eye", "handles that move the eye of the camera"),
    ("turn", "turn basis", "handles that turn the basis of the camera"),
    ("distance", "move plane", "a handle that moves the image plane: the distance d"),
    ("up", "turn up", "handles that turn the vector up, which makes the basis"),
)


def handles(options: OutsideOptions) -> tuple[tuple[str, str, str], ...]:
    """Return the handles that there are: up can be turned where it is drawn."""
    return HANDLES if options.target is not None else HANDLES[:-1]


def is_on(options: OutsideOptions, field: str) -> bool:
    value = getattr(options, field)
    if field == "formula":
        return value is not None
    return bool(min(value)) if isinstance(value, tuple) else bool(value)


def toggled(options: OutsideOptions, field: str) -> OutsideOptions:
    """Return the options with a switch toggled."""
    value: Any = not is_on(options, field)
    if field == "bundle":
        value = BUNDLE if value else (0, 0)
    if field == "formula":
        value = len(STAGES) if value else None
    return replace(options, **{field: value})


def with_gizmo(options: OutsideOptions, kind: str) -> OutsideOptions:
    value: Any = "none" if options.gizmo == kind else kind
    return replace(options, gizmo=value)
