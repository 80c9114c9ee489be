"""The options of the outside view: its parts and its camera."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from lucida.app.state.bounds import AtMost, OptionPart, Range
from lucida.renderer.camera.camera import Camera

Coordinate = Annotated[float, Range(-1e6, 1e6)]
Point = tuple[Coordinate, Coordinate, Coordinate]
# Stages of the growing key formula: the pixel, its centre on the viewport, -dw, uu, vv, its ray.
STAGES = ("pixel", "centre", "w", "u", "v", "ray")
MOST_GROWN = 7  # sessions of earlier versions may have it
Rays = Annotated[int, Range(0, 64)]  # rows, or columns, of viewing rays


@dataclass(frozen=True)
class OutsideOptions(OptionPart):
    """The outside view.

    camera: the free camera that looks at the scene and the other camera; None for one that shows
        both. turned: its angle around the scene, in degrees.
    bundle: rows and columns of the bundle of viewing rays; (0, 0) for none.
    gizmo: the action of the handles in the view: move the eye, turn the basis, or turn up, from
        which the basis then follows.
    target: a point to draw as **a**, with up as an arrow at the eye, from which a lecture makes a
        basis; None to draw neither.
    formula: the progress of the marked pixel's formula, in STAGES; None to hide it.
    pixels: show the image plane in pixels, with K's numbers.

    The numbers below are for a lecture's growing drawings: each counts the complete parts.
    points: points of the scene whose viewing rays are drawn; points_grown: their rays, then dots
    where these pass the image plane. image_opacity: the opacity of the picture on the image plane.
    half_line: the marked pixel's ray as p, d, the whole line with t = 1, 2, 3, and then without
        t < 0.
    meetings: all t at which that ray meets objects, then the least t > 0. simple: the parts of the
    simple camera: its eye, its direction, its viewport, the viewport's sides, d. basis_grown: the
    parts of a basis that is made from a target: w, up, u, v. numbers: write numbers in place of the
    formula's letters. to_parallel: the formula's progress from perspective to parallel.
    """

    camera: Camera | None = None
    volume: bool = True
    image: bool = True
    basis: bool = True
    grid: bool = True
    ray: bool = True
    bundle: tuple[Rays, Rays] = (0, 0)
    gizmo: Literal["none", "move", "turn", "up"] = "none"
    target: Point | None = None
    up: Point = (0.0, 1.0, 0.0)
    formula: Annotated[float, Range(0, MOST_GROWN)] | None = None
    pixels: bool = False
    points: Annotated[tuple[Point, ...], AtMost(16)] = ()
    points_grown: Annotated[float, Range(0, 2)] = 2.0
    image_opacity: Annotated[float, Range(0, 1)] = 0.9
    half_line: Annotated[float, Range(0, 4)] = 0.0
    meetings: Annotated[float, Range(0, 2)] = 0.0
    simple: Annotated[float, Range(0, 5)] = 0.0
    basis_grown: Annotated[float, Range(0, 4)] = 4.0
    numbers: bool = False
    to_parallel: Annotated[float, Range(0, 1)] = 0.0
    turned: Annotated[float, Range(0, 360)] = 0.0
