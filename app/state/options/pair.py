"""Drawings over both images."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from lucida.app.state.bounds import AtMost, OptionPart, Range

Coordinate = Annotated[float, Range(-1e6, 1e6)]
Point = tuple[Coordinate, Coordinate, Coordinate]


@dataclass(frozen=True)
class PairOptions(OptionPart):
    """The drawings over both images.

    parallels: points of the world, through each of which a line is drawn in the direction `along`.
    In perspective they meet in its vanishing point. vanishing: draw these lines. extended: the
    drawn fraction of each, from its near end.
    straight_lines: a grid of straight lines around the eye, bent as the lens bends them.
    footprint: an inset of the marked pixel's square, with the samples whose mean is its colour.
    """

    parallels: Annotated[tuple[Point, ...], AtMost(32)] = ()
    along: Point = (0.0, 0.0, -1.0)
    vanishing: bool = False
    extended: Annotated[float, Range(0, 1)] = 1.0
    straight_lines: bool = False
    footprint: bool = False
