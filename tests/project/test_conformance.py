"""Conformance: what surrounds the real programs, without any of them."""

from __future__ import annotations

import math
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from lucida.renderer.files.cameras import FORMATS
from tests.support.format_cameras import centred_camera, skewed_camera, straight_camera
from tools.conformance import cameras, report, run
from tools.conformance.measured import Checked, Job, PeerMissing, measured, needed

ROOT = Path(__file__).parents[2]
PAGES = {name: (ROOT / name).read_text("utf-8") for name in ("README.md", "docs/cameras.md")}
NAMES = [entry.name for entry in FORMATS]


def job(folder: Path, count: int = 20) -> Job:
    return Job(count, 7, folder, folder)


def outcome(worst: float, name: str = "opencv", bound: float = 1e-6) -> report.Outcome:
    told = measured("read", [worst], bound, cameras=1000)
    beside = measured("sizes", [0.0], 0.0, cameras=20, unit="pixels")
    return report.Outcome(name, Checked("a program 1.0", (told, beside)))


class TestMeasured:
    def test_the_worst_and_the_bound_there(self):
        told = measured("", [[1e-3, -2e-3], [0, 0]], [[1e-2, 4e-3], [1, 1]], cameras=2)
        assert (told.worst, told.bound, told.share, told.met) == (2e-3, 4e-3, 0.5, True)

    def test_a_small_error_beyond_its_own_bound_is_not_met(self):
        told = measured("", [5.0, 1.0], [10.0, 0.5], cameras=2)
        assert (told.worst, told.share, told.met) == (5.0, 2.0, False)

    @pytest.mark.parametrize("errors", [[], [math.nan], [0.0, math.inf]])
    def test_no_number_is_not_met(self, errors):
        assert not measured("", errors, cameras=1).met

    def test_what_cannot_be_imported_is_named(self):
        with pytest.raises(PeerMissing, match="no_such_peer"):
            needed("no_such_peer")


class TestCameras:
    @pytest.mark.parametrize("make", [straight_camera, skewed_camera, centred_camera])
    def test_the_pixels_are_those_of_the_rays(self, make, tmp_path):
        kinds = set()
        for case in cameras.cases(job(tmp_path), make, parallel=True):
            kinds.add(case.camera.projection)
            assert (case.pixels >= 0).all() and (case.pixels <= case.size).all()
            column, row = case.pixels.T - 0.5
            ray = case.camera.ray(row, column, case.size)
            aside = np.cross(case.points - ray.origin, ray.direction)
            assert np.abs(aside).max() < 1e-9 * np.abs(ray.direction).max() * 100
        assert kinds == {"perspective", "parallel"}


class TestRun:
    @pytest.mark.parametrize("name", NAMES)
    def test_each_format_has_a_check(self, name):
        assert callable(import_module(f"tools.conformance.formats.{name}").check)

    @pytest.mark.parametrize("name", ["view", "nerf"])
    def test_those_that_need_no_program(self, name):
        found = run.outcome(name, 20)
        assert found.met and found.checked is not None, found.problem

    def test_a_check_that_fails_is_told(self, monkeypatch, capsys):
        def broken(job):
            raise ValueError("out of luck\nand more")

        monkeypatch.setattr("tools.conformance.formats.nerf.check", broken)
        found = run.outcome("nerf", 1)
        assert (found.met, found.problem) == (False, "ValueError: out of luck")
        assert "out of luck" in capsys.readouterr().err


class TestPages:
    @pytest.mark.parametrize("name", PAGES)
    def test_the_table_is_of_a_run(self, name):
        block = PAGES[name].partition(report.BEGIN)[2].partition(report.END)[0]
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
