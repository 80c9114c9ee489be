"""The measurements as tables: for the terminal, for docs/speed.md and as JSON.

Owns the tables' form and the targets. Knows nothing of how anything is measured.
"""

from __future__ import annotations

import json
import math
import os
import platform
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from importlib import metadata
from pathlib import Path
from typing import Any

from lucida.renderer.system.errors import LucidaError
from tools.benchmarks.measure import Timing

FORMAT = 1  # of the JSON file
OURS = "Lucida"  # under which our times stand
BEGIN, END = "<!-- bench:begin -->", "<!-- bench:end -->"


@dataclass(frozen=True)
class Target:
    """A number that was promised, and what it came to. unit: "x" for a ratio, "ms", "s"..."""

    name: str
    measured: float
    bound: float
    unit: str
    at_least: bool = True

    @property
    def met(self) -> bool:
        """False for NaN too: what could not be measured is not met."""
        if self.at_least:
            return self.measured >= self.bound
        return self.measured <= self.bound

    def cells(self) -> tuple[str, ...]:
        sign = "at least" if self.at_least else "at most"
        return (
            self.name,
            f"{sign} {self.bound:g} {self.unit}",
            f"{short(self.measured)} {self.unit}",
            "met" if self.met else "falls short",
        )


TARGET_HEADER = ("target", "promised", "measured", "")


@dataclass
class Table:
    """One table. name: what --only takes. rows: one text a column of the header; the first is
    aligned left. data: the numbers behind the rows, for the JSON file."""

    name: str
    title: str
    header: tuple[str, ...]
    rows: list[tuple[str, ...]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    targets: list[Target] = field(default_factory=list)
    data: list[dict[str, Any]] = field(default_factory=list)

    def add(self, *cells: str, **numbers: Any) -> None:
        """A row, and the numbers behind it."""
        if len(cells) != len(self.header):
            raise ValueError(f"{self.name}: {len(cells)} cells under {len(self.header)} headings")
        self.rows.append(cells)
        if numbers:
            self.data.append(numbers)

    def compare(self, *labels: str, timings: dict[str, Timing], **numbers: Any) -> dict[str, float]:
        """Add a row of times: Lucida's, its quartiles and Mrays/s where there are `rays`, then each
        peer's. Return each peer's time over Lucida's."""
        ours, *peers = timings.values()
        ratios = {n: t.median_s / ours.median_s for n, t in timings.items() if t is not ours}
        cells = [short(numbers["rays"] / ours.median_s / 1e6)] if "rays" in numbers else []
        cells += [f"{short(1e3 * t.median_s)} ({times(t.median_s / ours.median_s)})" for t in peers]
        times_of = {name: timing.numbers() for name, timing in timings.items()}
        self.add(*labels, ms(ours), *cells, times=times_of, **numbers)
        return ratios

    def target(
        self, name: str, measured: float, bound: float, unit: str, at_least: bool = True
    ) -> None:
        self.targets.append(Target(name, float(measured), bound, unit, at_least))


# Numbers as text.


def short(number: float) -> str:
    """Three digits: 0.123, 1.23, 12.3, 123."""
    if not math.isfinite(number):
        return "-"
    digits = 3 if abs(number) < 1 else 2 if abs(number) < 10 else 1 if abs(number) < 100 else 0
    return f"{number:.{digits}f}"


def ms(timing: Timing) -> str:
    """The median in ms, with the quartiles: "5.12 (5.01 to 5.30)"."""
    low, middle, high = (short(1e3 * s) for s in (timing.low_s, timing.median_s, timing.high_s))
    return f"{middle} ({low} to {high})"


def times(number: float) -> str:
    return f"{short(number)}x"


# Tables as text.


def text(table: Table) -> str:
    """For the terminal."""
    parts = [f"{table.title}  [{table.name}]", "", _aligned([table.header, *table.rows])]
    parts += [f"  {note}" for note in table.notes]
    if table.targets:
        parts += ["", _aligned([TARGET_HEADER, *(target.cells() for target in table.targets)])]
    return "\n".join(parts) + "\n"


def markdown(table: Table) -> str:
    """For docs/speed.md: the table and its notes, without the targets."""
    lines = [f"**{table.title}**", "", *_pipes(table.header, table.rows)]
    if table.notes:
        lines += ["", *table.notes]
    return "\n".join(lines) + "\n"


def targets(tables: Iterable[Table], missed: bool = False) -> Table:
    """Return a table of the targets of all tables; or of those that fall short."""
    rows = [t.cells() for table in tables for t in table.targets if not (missed and t.met)]
    return Table("targets", "Targets that fall short" if missed else "Targets", TARGET_HEADER, rows)


def losses(tables: Iterable[Table]) -> Table:
    """Return a table of the rows in which a peer was faster, and of who was fastest."""
    found = []
    for table in tables:
        for cells, numbers in zip(table.rows, table.data, strict=False):
            all_s = {name: own["median_s"] for name, own in numbers.get("times", {}).items()}
            if OURS not in all_s:
                continue
            fastest = min(all_s, key=lambda name: all_s[name])
            if all_s[fastest] < all_s[OURS]:
                columns = next(k for k, head in enumerate(table.header) if head.startswith(OURS))
                labels = zip(table.header[:columns], cells, strict=False)
                where = ", ".join((table.name, *(_label(head, cell) for head, cell in labels)))
                figures = (short(1e3 * all_s[name]) for name in (fastest, OURS))
                found.append((where, fastest, *figures))
    header = ("where", "who is faster", "ms", "Lucida ms")
    return Table("losses", "Where a peer is faster", header, found)


def _label(head: str, cell: str) -> str:
    """A number does not say what it is of."""
    return f"{head} {cell}" if cell.strip("0123456789.,") == "" else cell


def _aligned(rows: list[tuple[str, ...]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for cells in rows:
        first, *others = zip(cells, widths, strict=True)
        line = [first[0].ljust(first[1]), *(cell.rjust(width) for cell, width in others)]
        lines.append("  " + "  ".join(line).rstrip())
    lines.insert(1, "  " + "  ".join("-" * width for width in widths))
    return "\n".join(lines)


def _pipes(header: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> list[str]:
    lines = [header, ("---", *("---:" for _ in header[1:])), *rows]
    return ["| " + " | ".join(cells) + " |" for cells in lines]


# Files.


def machine() -> dict[str, Any]:
    """Describe the machine of the measurements."""
    cpu = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        found = re.search(r"^model name\s*:\s*(.+)$", cpuinfo.read_text(), re.MULTILINE)
        cpu = found[1] if found else cpu
    return {
        "cpu": cpu,
        "processors": os.cpu_count(),
        "load": load(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "packages": {name: metadata.version(name) for name in ("numpy", "numba", "llvmlite")},
    }


def load() -> float | None:
    """Return the mean number of runnable threads in the last minute; None if the system does not
    report it.
    """
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else None


def as_json(tables: Iterable[Table], **settings: Any) -> str:
    """Return everything, for other programs."""
    whole = {"format": FORMAT, **settings, "tables": [asdict(table) for table in tables]}
    return json.dumps(whole, indent=1, default=float) + "\n"


def between_marks(document: str, block: str) -> str:
    """The document with what lies between the two marks replaced. Raises LucidaError."""
    before, begin, rest = document.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise LucidaError("docs/speed.md", f"{BEGIN} or {END} is missing", "put them in")
    return f"{before}{BEGIN}\n{block.strip()}\n{END}{after}"
