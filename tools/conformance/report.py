"""The findings as tables: for the terminal and for docs/cameras.md.

Owns the tables' form and the words for each format. Knows nothing of how anything is checked.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from lucida.renderer.system.errors import LucidaError
from tools.conformance.cameras import MOST_SIDE, POINTS
from tools.conformance.measured import Checked, Measured

BEGIN, END = "<!-- conformance:begin -->", "<!-- conformance:end -->"

WHAT = {
    "view": "Lucida's [view file](files.md#view-files), .toml",
    "opencv": "K, R, t or rvec, lens: FileStorage .yml, .json and .xml, and the formats below",
    "colmap": "cameras and images in a folder, .bin or .txt, with lenses; only read",
    "nerf": "transforms.json of NeRF, instant-ngp and nerfstudio, with lenses; only read",
    "gltf": "the cameras of a .gltf or .glb file at their nodes",
    "opengl": "view and projection matrix, .txt, by columns or rows",
}
HEADER = ("format", "checked against", "cameras", "worst error", "bound")


INTRO = """\
`make conformance` writes this table. In each direction (the other program reads Lucida's file, and
Lucida reads the other program's) it compares at least {count} random cameras, off-axis and with any
aspect ratio, skewed and parallel if the format permits, with {points} points each. The error is the
distance between both images of a point, in pixels, in images of up to {side} pixels per side."""


@dataclass(frozen=True)
class Outcome:
    """checked: None where nothing could be checked; problem: then why. failed: whether that is a
    fault, and not a program that is not there."""

    format: str
    checked: Checked | None = None
    problem: str = ""
    failed: bool = False

    @property
    def met(self) -> bool:
        if self.checked is None:
            return not self.failed
        return bool(self.checked.measured) and all(part.met for part in self.checked.measured)

    @property
    def row(self) -> tuple[str, ...]:
        """Under HEADER: the worst of the pixels, and all cameras that were checked."""
        cells = (f"`{self.format}`",)
        if self.checked is None:
            return (*cells, f"not checked here: {self.problem}", "-", "-", "-")
        of_pixels = [part for part in self.checked.measured if not part.beside]
        worst = max(of_pixels, key=lambda part: part.share if math.isfinite(part.share) else 1e99)
        count = str(sum(part.cameras for part in of_pixels))
        return (*cells, self.checked.peer, count, quantity(worst.worst, "px"), bound(worst))


def quantity(value: float, unit: str) -> str:
    """Two digits: 3.1e-11 px, 1e-6 px, 0.0042 px."""
    if not math.isfinite(value):
        return "no number"
    return f"{value:.2g} {unit}".replace("e-0", "e-")


def bound(part: Measured) -> str:
    return quantity(part.bound, part.unit)


def text(outcome: Outcome) -> str:
    """For the terminal: each of the checks."""
    if outcome.checked is None:
        return f"{outcome.format:8} {'FAILED' if outcome.failed else 'left out'}: {outcome.problem}"
    lines = [f"{outcome.format:8} {outcome.checked.peer}"]
    for part in outcome.checked.measured:
        told = "" if part.met else "  BEYOND ITS BOUND"
        numbers = f"{quantity(part.worst, part.unit)} of at most {bound(part)}"
        used = f"at most {100 * part.share:.2g} % of a bound was used"
        lines.append(f"    {part.what}: {part.cameras} cameras, {numbers}; {used}{told}")
    return "\n".join(lines)


def page(outcomes: Sequence[Outcome], count: int) -> str:
    """For docs/cameras.md: the formats, then what else was compared. count: cameras a check."""
    intro = INTRO.format(count=count, points=POINTS, side=MOST_SIDE)
    header = (HEADER[0], "what", *HEADER[1:])
    rows = [(row[0], WHAT[o.format], *row[1:]) for o in outcomes for row in [o.row]]
    others = [
        f"- `{o.format}`: {part.what}, {part.cameras} times: {quantity(part.worst, part.unit)} "
        f"of at most {bound(part)}"
        for o in outcomes
        if o.checked is not None
        for part in o.checked.measured
        if part.beside
    ]
    beside = ["", "Also compared:", "", *others] if others else []
    return "\n".join([*pipes(header, rows), "", intro, *beside])


def pipes(header: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    for row in rows:
        if len(row) != len(header):
            raise ValueError(f"{len(row)} cells under {len(header)} headings")
    lines = [header, ["---"] * len(header), *rows]
    return ["| " + " | ".join(cells) + " |" for cells in lines]


def between_marks(document: str, block: str, name: str) -> str:
    """The document with what lies between the two marks replaced. Raises LucidaError."""
    before, begin, rest = document.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise LucidaError(name, f"{BEGIN} or {END} is missing", "put them in")
    return f"{before}{BEGIN}\n\n{block.strip()}\n\n{END}{after}"
