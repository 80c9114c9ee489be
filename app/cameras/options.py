"""The camera's fields as command-line options.

This module is quick to import: heavy modules are imported inside functions.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from lucida.renderer.system.errors import LucidaError, errors_as, not_together

if TYPE_CHECKING:
    from lucida.renderer.camera.lenses import Lens
    from lucida.renderer.scene.model import View

CAMERA_FIELDS = ("eye", "u", "v", "w", "distance", "viewport", "projection", "near", "far", "lens")
CAMERA_OPTIONS = (*CAMERA_FIELDS, "fit", "target", "up", "fov")


def numbers(count: int) -> Callable[[str], Any]:
    """Return a function that reads a number, or a tuple of `count` numbers between commas."""

    def read(text: str) -> Any:
        try:
            values = tuple(float(part) for part in text.replace(",", " ").split())
        except ValueError:
            values = ()
        if len(values) != count:
            what = f"{count} numbers" if count > 1 else "a number"
            example = {1: "1.5", 3: "0,0,5"}.get(count, "-0.5,0.5,-0.5,0.5")
            raise argparse.ArgumentTypeError(f"{text!r} is not {what}; give e.g. {example}")
        return values if count > 1 else values[0]

    return read


NO_LENS = "none"


def lens_word(text: str) -> Lens | str:
    """Return the lens of a word such as brown:k1=-0.2,k2=0.03, or NO_LENS."""
    from lucida.renderer.camera.lenses import Lens

    if text == NO_LENS:
        return text
    model, _, coefficients = text.partition(":")
    pairs = [part.partition("=") for part in coefficients.split(",") if part]
    for name, sign, _ in pairs:
        if not sign:
            raise argparse.ArgumentTypeError(f"{name!r} has no value; give {name}=0.1")
    given = {name.strip(): numbers(1)(value) for name, _, value in pairs}
    if len(given) < len(pairs):
        raise argparse.ArgumentTypeError("a coefficient is given twice; give it once")
    try:
        return Lens(model, given)
    except LucidaError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def add_camera_options(parser: argparse.ArgumentParser) -> None:
    """Add the camera's fields as options: each replaces the view's own."""
    group = parser.add_argument_group("camera", "options override the camera of the scene or view")
    three, one = {"type": numbers(3), "metavar": "X,Y,Z"}, {"type": numbers(1)}
    projections = ("perspective", "parallel")
    options: list[tuple[str, dict[str, Any], str]] = [
        ("eye", three, "the position: --eye 0,0,5"),
        ("target", three, "look at this point, with an orthonormal basis"),
        ("up", three, "the up direction for --target (default: 0,1,0)"),
        ("u", three, "the basis: right"),
        ("v", three, "the basis: up"),
        ("w", three, "the basis: back"),
        ("distance", one | {"metavar": "D"}, "from the eye to the viewport, along -w"),
        ("fov", one | {"metavar": "DEG"}, "vertical field of view, instead of the distance"),
        (
            "viewport",
            {"type": numbers(4), "metavar": "L,R,B,T"},
            "left, right, bottom, top, unchanged without --fit",
        ),
        ("projection", {"choices": projections}, "perspective or parallel viewing rays"),
        ("near", one | {"metavar": "N"}, "clip plane, in units of w"),
        ("far", one | {"metavar": "F"}, "clip plane, in units of w"),
        (
            "lens",
            {"type": lens_word, "metavar": "MODEL:K=V,..."},
            "brown:k1=-0.2,k2=0.03, equirectangular, ...; none: no lens",
        ),
        (
            "fit",
            {"action": argparse.BooleanOptionalAction},
            "extend the viewport to the image's aspect ratio",
        ),
    ]
    for name, how, help in options:
        group.add_argument(f"--{name}", help=help, **how)


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
    if fields.get("lens") == NO_LENS:
        fields["lens"] = None
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
                raise not_together(f"--{other}", f"--{one}")


def _looking(view: View, given: dict[str, Any]) -> View:
    """Return the view towards --target or, with --up alone, rotated about its own direction."""
    from .presets import look_at

    camera = view.camera
    ahead = [eye - back for eye, back in zip(camera.eye, camera.w, strict=True)]
    return look_at(view, camera.eye, given.get("target", ahead), given.get("up", (0.0, 1.0, 0.0)))


def _as_wide(view: View, fov_deg: float) -> View:
    """Return the view with a vertical field of view, set by the viewport's distance."""
    from lucida.renderer.camera.navigation import distance_for

    camera = view.camera
    if camera.is_parallel:
        problem = "does not apply to a parallel projection"
        raise LucidaError("--fov", problem, "give --viewport, or --projection perspective")
    with errors_as("--fov"):
        camera = replace(camera, distance=distance_for(camera, fov_deg))
    return replace(view, camera=camera)
