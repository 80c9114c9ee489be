"""Conformance: what surrounds the real programs, without any of them."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import pytest

from lucida.renderer.files.cameras import FORMATS
from tools.conformance import report, run

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/cameras.md").read_text("utf-8")
NAMES = [entry.name for entry in FORMATS]


class TestRun:
    @pytest.mark.parametrize("name", NAMES)
    def test_each_format_has_a_check(self, name):
        assert callable(import_module(f"tools.conformance.formats.{name}").check)

    @pytest.mark.parametrize("name", ["view", "nerf"])
    def test_those_that_need_no_program(self, name):
        found = run.outcome(name, 20)
        assert found.met and found.checked is not None, found.problem


class TestPage:
    def test_the_table_is_of_a_run(self):
        block = PAGE.partition(report.BEGIN)[2].partition(report.END)[0]
        header, _, *rows = [
            [cell.strip() for cell in line.split("|")[1:-1]]
            for line in block.splitlines()
            if line.startswith("|")
        ]
        assert [cell for cell in header if cell != "what"] == list(report.HEADER)
        tables = [dict(zip(header, row, strict=True)) for row in rows]
        assert [row["format"] for row in tables] == [f"`{name}`" for name in NAMES]
        for row in tables:
            if not row["checked against"].startswith("not checked here: "):
                assert int(row["cameras"]) >= 1000
                worst, bound = (float(row[part].split()[0]) for part in ("worst error", "bound"))
                assert worst <= bound
