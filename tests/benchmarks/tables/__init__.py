"""What is measured: a module for each table, with a function measure(run) -> list of Table."""

from __future__ import annotations

from collections.abc import Callable

from tests.benchmarks.report import Table
from tests.benchmarks.run import Run
from tests.benchmarks.tables import (
    build,
    cancel,
    compilation,
    memory,
    moving,
    scaling,
    secondary,
    shading,
    visibility,
    watertight,
    window,
)

Measure = Callable[[Run], list[Table]]

TABLES: dict[str, Measure] = {
    "visibility": visibility.measure,
    "shading": shading.measure,
    "secondary": secondary.measure,
    "build": build.measure,
    "scaling": scaling.measure,
    "compilation": compilation.measure,
    "cancel": cancel.measure,
    "memory": memory.measure,
    "moving": moving.measure,
    "watertight": watertight.measure,
    "window": window.measure,
}
