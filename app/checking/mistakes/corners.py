"""Viewing rays from points of the viewport in the world, and their mistakes: either its first pixel
and the steps between pixels, or a corner and two edges.
"""

from __future__ import annotations

from collections.abc import Set

from app.checking.mistakes.bodies import POINT
from app.checking.mistakes.program import CodeLine, Mistake, Program
from renderer.pixels import Indexing

PART = "Any camera"
GRID = frozenset({"eye", "pixel00", "delta_u", "delta_v"})
EDGES = frozenset({"eye", "bottom_left", "horizontal", "vertical"})


def has_corners(words: Set[str]) -> bool:
    return words >= GRID or words >= EDGES


def corner_program(words: frozenset[str], indexing: Indexing, from_top: bool) -> Program:
    """Return the program that makes origin and direction, in perspective."""
    point, written = _grid(indexing) if words >= GRID else _edges(words, indexing, from_top)
    made = [
        Mistake(name, (("point", f"point = {code}"),), hint, PART) for name, code, hint in written
    ]
    for name, origin, direction, hint in (
        ("a point, not a direction", "eye", "point", POINT),
        ("points backwards", "eye", "eye - point",
         "That points backwards: the direction is the point minus the eye, in this order."),
        ("the origin on the viewport", "point", "point - eye",
         "In perspective all rays start at the eye, not on the image plane."),
        ("no eye", "vector(0, 0, 0)", "point - eye",
         "The ray begins at the eye e, not at the world's origin."),
        ("normalised", "eye", "normalized(point - eye)",
         "The direction is right, its length is not: do not normalise it."),
    ):  # fmt: skip
        rewritten = [("origin", f"origin = {origin}")] * (origin != "eye")
        rewritten += [("direction", f"direction = {direction}")] * (direction != "point - eye")
        made.append(Mistake(name, tuple(rewritten), hint, PART, name != "normalised"))
    lines = (
        CodeLine("point", f"point = {point}"),
        CodeLine("origin", "origin = eye"),
        CodeLine("direction", "direction = point - eye"),
    )
    return Program(lines, tuple(made), ("origin", "direction"))


Written = list[tuple[str, str, str]]


def _grid(indexing: Indexing) -> tuple[str, Written]:
    first = "- 1" if indexing is Indexing.LECTURE else ""
    i, j = (f"({name} {first})" if first else name for name in "ij")

    def at(down: str, across: str, sign: str = "+") -> str:
        return f"pixel00 + {across}*delta_u {sign} {down}*delta_v"

    return at(i, j), [
        ("half a pixel more", at(f"({i} + 0.5)", f"({j} + 0.5)"),
         "The first pixel's point is its centre already: no half pixel is added."),
        ("half a pixel less", at(f"({i} - 0.5)", f"({j} - 0.5)"),
         "The first pixel's point is its centre already: no half pixel is subtracted."),
        ("one pixel more", at(f"({i} + 1)", f"({j} + 1)"),
         "Count the steps from the first pixel: to itself there is none."),
        ("row and column exchanged", at(j, i),
         "The column steps across the image, along delta_u, the row down, along delta_v: "
         "they are exchanged."),
        ("upwards", at(i, j, "-"),
         "delta_v leads to the row below already: it needs no minus sign."),
        ("steps without the first pixel", f"{j}*delta_u + {i}*delta_v",
         "Those are steps alone: begin at the first pixel's point."),
    ]  # fmt: skip


def _edges(words: frozenset[str], indexing: Indexing, from_top: bool) -> tuple[str, Written]:
    if "x01" in words:
        s, t = "x01", "y01"
    else:
        s, t = f"(j {indexing.offset}) / width", f"(i {indexing.offset}) / height"
    up = f"(1 - {t})" if from_top else t
    down = t if from_top else f"(1 - {t})"

    def at(across: str, along: str) -> str:
        return f"bottom_left + {across}*horizontal + {along}*vertical"

    flipped = (
        "Rows count downwards here, and the corner is the lower one: v needs its minus sign."
        if from_top
        else "Here rows count upwards, as v does: v needs no minus sign."
    )
    return at(s, up), [
        ("rows the wrong way round", at(s, down), flipped),
        ("columns count leftwards", at(f"(1 - {s})", up),
         "Columns count to the right, as u does: u has no minus sign."),
        ("across and along exchanged", at(up, s),
         "The first coordinate goes across the image and gives u, the second gives v."),
        ("from the middle", at(f"({s} - 0.5)", f"({up} - 0.5)"),
         "The corner is the edge, not the middle: 0.5 is subtracted once too often."),
        ("[-1, 1] for [0, 1]", at(f"(2*{s} - 1)", f"(2*{up} - 1)"),
         "The coordinates reach over [0, 1] from the corner, not over [-1, 1]."),
        ("edges without the corner", f"{s}*horizontal + {up}*vertical",
         "Those are steps alone: begin at the corner."),
    ]  # fmt: skip
