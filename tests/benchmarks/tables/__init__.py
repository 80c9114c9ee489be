"""The tables: a module for each, with a function measure(run) -> list of Table.

They are imported when they are used: some are also processes of their own.
"""

from __future__ import annotations

from importlib import import_module

from tests.benchmarks.report import Table
from tests.benchmarks.run import Run

TABLES = (
    "visibility",
    "processor",
    "lenses",
    "shading",
    "build",
    "scaling",
    "compilation",
    "cancel",
    "window",
)


def measure(name: str, run: Run) -> list[Table]:
    """The tables of one of TABLES."""
    made: list[Table] = import_module(f"{__name__}.{name}").measure(run)
    return made
