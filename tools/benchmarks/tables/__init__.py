"""The tables: a module for each, with a function measure(run) -> list of Table."""

from __future__ import annotations

from collections.abc import Callable

from tools.benchmarks.report import Table
from tools.benchmarks.run import Run
from tools.benchmarks.tables import build, lenses, processor, visibility

TABLES: dict[str, Callable[[Run], list[Table]]] = {
    "visibility": visibility.measure,
    "processor": processor.measure,
    "lenses": lenses.measure,
    "build": build.measure,
}
