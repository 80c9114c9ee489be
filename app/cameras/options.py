"""The camera's fields as command-line options, and as read from a copied command line.

Quick to import: heavy modules are imported inside functions.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from renderer.errors import LucidaError

if TYPE_CHECKING:
    from renderer.scene.model import View

CAMERA_FIELDS = ("eye", "u", "v", "w", "distance", "viewport", "projection", "near", "far")
CAMERA_OPTIONS = (*CAMERA_FIELDS, "fit", "target", "up", "fov")


def numbers(count: int) -> Callable[[str], tuple[float, ...]]:
    """Return a function that reads `count` numbers with commas between them."""

    def read(text: str) -> tuple[float, ...]:
        try:
            values = tuple(float(part) for part in text.replace(",", " ").split())
        except ValueError:
            values = ()
        if len(values) != count:
            example = "0,0,5" if count == 3 else "-0.5,0.5,-0.5,0.5"
            raise argparse.ArgumentTypeError(
                f"{text!r} is not {count} numbers; give e.g. {example}"
            )
        return values

    return read


def number(text: str) -> float:
    """Parse one number."""
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number; give e.g. 1.5") from None


def add_camera_options(parser: argparse.ArgumentParser) -> None:
    """Add the camera's fields as options: each replaces the view's own."""
    group = parser.add_argument_group("camera", "each number replaces the scene's or view's own")
    three, four = numbers(3), numbers(4)
    group.add_argument("--eye", type=three, metavar="X,Y,Z", help="the position: --eye 0,0,5")
    group.add_argument(
        "--target",
        type=three,
        metavar="X,Y,Z",
        help="look at this point, with an orthonormal basis",
    )
    group.add_argument(
        "--up", type=three, metavar="X,Y,Z", help="what is upwards then (default: 0,1,0)"
    )
    for name, role in (("u", "right"), ("v", "up"), ("w", "back")):
        group.add_argument(f"--{name}", type=three, metavar="X,Y,Z", help=f"the basis: {role}")
    group.add_argument("--distance", type=number, metavar="D", help="of the viewport, along -w")
    group.add_argument(
        "--fov", type=number, metavar="DEG", help="vertical field of view, in the distance's place"
    )
    group.add_argument(
        "--viewport", type=four, metavar="L,R,B,T", help="left, right, bottom, top, as it stands"
    )
    group.add_argument("--projection", choices=("perspective", "parallel"), help="of the rays")
    group.add_argument("--near", type=number, metavar="N", help="clip plane, in units of w")
    group.add_argument("--far", type=number, metavar="F", help="clip plane, in units of w")
    group.add_argument(
        "--fit",
        action=argparse.BooleanOptionalAction,
        help="widen or heighten the viewport to the image's shape",
    )


def with_camera_options(arguments: argparse.Namespace, view: View) -> View:
    """Return the view with the options applied: its fields, then its direction, then its width.

    Without --fit a viewport is used as it is, whatever the image's shape. Raises LucidaError.
    """
    given = {name: getattr(arguments, name) for name in CAMERA_OPTIONS}
    given = {name: value for name, value in given.items() if value is not None}
    if not given:
        return view
    _check_beside(given)
    fields = {name: given[name] for name in CAMERA_FIELDS if name in given}
    fit = given.get("fit", view.fit and "viewport" not in given)
    try:
        view = replace(view, camera=replace(view.camera, **fields), fit=fit)
        if "target" in given or "up" in given:
            view = _looking(view, given)
    except LucidaError as error:
        raise LucidaError(f"--{error.field}", error.problem, error.remedy) from None
    return _as_wide(view, given["fov"]) if "fov" in given else view


def _check_beside(given: dict[str, Any]) -> None:
    """Raise LucidaError if two options set the same thing."""
    for one, others in (("target", "uvw"), ("up", "uvw"), ("fov", ("distance",))):
        for other in others:
            if one in given and other in given:
                raise LucidaError(f"--{other}", f"is given beside --{one}", "give one of the two")


def _looking(view: View, given: dict[str, Any]) -> View:
    """Return the view towards --target or, with --up alone, rotated about its own direction."""
    from app.cameras.presets import look_at

    camera = view.camera
    ahead = [eye - back for eye, back in zip(camera.eye, camera.w, strict=True)]
    return look_at(view, camera.eye, given.get("target", ahead), given.get("up", (0.0, 1.0, 0.0)))


def _as_wide(view: View, fov_deg: float) -> View:
    """Return the view with a vertical field of view, set by the viewport's distance."""
    from app.cameras.navigation import distance_for

    camera = view.camera
    if camera.is_parallel:
        problem = "is nothing that a parallel projection has"
        raise LucidaError("--fov", problem, "give --viewport, or --projection perspective")
    try:
        camera = replace(camera, distance=distance_for(camera, fov_deg))
    except LucidaError as error:
        raise LucidaError("--fov", error.problem, error.remedy) from None
    return replace(view, camera=camera)
