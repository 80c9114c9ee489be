"""Conformance: what surrounds the real programs, without any of them."""

from __future__ import annotations

import math
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from renderer.camera_formats import FORMATS
from renderer.errors import LucidaError
from tests.conformance import __main__ as command
from tests.conformance import cameras, report, run
from tests.conformance.measured import Checked, Job, PeerMissing, measured, needed
from tests.support.format_cameras import centred_camera, skewed_camera, straight_camera

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

    def test_bounds_of_0_are_of_what_is_the_same(self):
        assert measured("", [0.0], 0.0, cameras=1).met
        assert not measured("", [1e-300], 0.0, cameras=1).met

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

    def test_they_are_what_they_are_called(self, tmp_path):
        skewed = [case.camera for case in cameras.cases(job(tmp_path), skewed_camera)]
        assert {camera.determinant < 0 for camera in skewed} == {True, False}
        off_axis = [case.camera.viewport for case in cameras.cases(job(tmp_path), straight_camera)]
        assert min(abs(left + right) for left, right, _, _ in off_axis) > 0
        centred = [case.camera.viewport for case in cameras.cases(job(tmp_path), centred_camera)]
        assert {left + right for left, right, _, _ in centred} == {0}

    def test_the_same_on_every_day(self, tmp_path):
        one, other = (
            [case.camera for case in cameras.cases(job(tmp_path), straight_camera)]
            for _ in range(2)
        )
        assert one == other

    def test_another_format_is_not_taken(self, tmp_path):
        (case,) = cameras.cases(job(tmp_path, 1), straight_camera)
        with pytest.raises(AssertionError, match="was taken for opencv"):
            cameras.read(case.file("opencv"), "nerf")

    def test_computer_vision_s_formula(self, tmp_path):
        for case in cameras.cases(job(tmp_path), skewed_camera):
            K, R, t = case.camera.intrinsics(case.size, "corner")
            assert np.abs(cameras.sight(K, R, t, case.points) - case.pixels).max() < 1e-6

    def test_clip_space(self, tmp_path):
        for case in cameras.cases(job(tmp_path), skewed_camera, parallel=True):
            clip = case.camera.clip_from_camera(0.1, 100) @ case.camera.camera_from_world
            assert (
                np.abs(cameras.from_clip(clip, case.points, case.size) - case.pixels).max() < 1e-6
            )


class TestRun:
    @pytest.mark.parametrize("name", NAMES)
    def test_each_format_has_a_check(self, name):
        assert callable(import_module(f"tests.conformance.formats.{name}").check)

    @pytest.mark.parametrize("name", ["view", "nerf", "opengl"])
    def test_those_that_need_no_program(self, name):
        found = run.outcome(name, 20)
        assert found.met and found.checked is not None, found.problem

    def test_a_check_that_fails_is_told(self, monkeypatch, capsys):
        def broken(job):
            raise ValueError("out of luck\nand more")

        monkeypatch.setattr("tests.conformance.formats.nerf.check", broken)
        found = run.outcome("nerf", 1)
        assert (found.met, found.problem) == (False, "ValueError: out of luck")
        assert "out of luck" in capsys.readouterr().err

    def test_a_missing_one_is_no_failure(self, monkeypatch):
        def missing(job):
            raise PeerMissing("no such library")

        monkeypatch.setattr("tests.conformance.formats.nerf.check", missing)
        found = run.outcome("nerf", 1)
        assert (found.met, found.problem) == (True, "no such library")


class TestReport:
    def test_a_row(self):
        row = outcome(2.5e-9).row
        assert row == ("`opencv`", "a program 1.0", "1000", "2.5e-9 px", "1e-6 px")

    def test_the_row_is_of_the_check_nearest_to_its_bound(self):
        near = measured("", [0.5], 1.0, cameras=10)
        far = measured("", [0.9], 9.0, cameras=10)
        row = report.Outcome("opencv", Checked("x", (far, near))).row
        assert row[2:] == ("20", "0.5 px", "1 px")

    def test_one_that_is_left_out(self):
        left_out = report.Outcome("gltf", None, "no pygltflib")
        assert left_out.row[1:] == ("not checked here: no pygltflib", "-", "-", "-")
        assert report.text(left_out) == "gltf     left out: no pygltflib"
        assert "FAILED" in report.text(report.Outcome("gltf", None, "crashed", True))

    def test_beyond_is_told(self):
        beyond = outcome(1.0)
        assert not beyond.met and "BEYOND ITS BOUND" in report.text(beyond)
        assert outcome(1e-7).met and "BEYOND" not in report.text(outcome(1e-7))

    def test_pages(self):
        found = [outcome(1e-9, name) for name in NAMES]
        page, readme = report.page(found, 1000), report.readme(found)
        assert "- `opencv`: sizes, 20 times: 0 pixels of at most 0 pixels" in page
        for text, columns in ((page, 6), (readme, 5)):
            rows = [line for line in text.splitlines() if line.startswith("|")]
            assert len(rows) == len(NAMES) + 2
            assert {row.count("|") for row in rows} == {columns + 1}

    def test_only_what_lies_between_the_marks_is_replaced(self):
        text = f"a\n{report.BEGIN}\nold\n{report.END}\nb"
        new = report.between_marks(text, " new ", "page")
        assert new == f"a\n{report.BEGIN}\n\nnew\n\n{report.END}\nb"
        with pytest.raises(LucidaError, match="page: "):
            report.between_marks("no marks", "new", "page")

    def test_rows_fit_their_header(self):
        with pytest.raises(ValueError, match="1 cells under 2"):
            report.pipes(("a", "b"), [("x",)])


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


class TestCommand:
    def test_a_mistake_is_one_line(self, capsys):
        for arguments, told in (
            (["--only", "opencv,colmapp"], "--only: 'colmapp' is unknown; give one of view"),
            (["--count", "0"], "--count: 0 is not above 0"),
            (["--document", "--only", "opencv"], "--document: needs all formats"),
            (["--document", "--count", "10"], "--document: needs all formats"),
        ):
            assert command.main(arguments) == 2
            assert told in capsys.readouterr().err

    def test_the_status_tells_what_is_beyond(self, monkeypatch, capsys):
        monkeypatch.setattr(command, "outcomes", lambda names, count: [outcome(1.0)])
        assert command.main(["--only", "opencv"]) == 1
        assert "not as it should be: opencv" in capsys.readouterr().err
        monkeypatch.setattr(command, "outcomes", lambda names, count: [outcome(1e-9)])
        assert command.main(["--only", "opencv"]) == 0

    @pytest.mark.parametrize(("worst", "status"), [(1e-9, 0), (1.0, 1)])
    def test_the_pages_are_written_where_all_is_met(self, worst, status, tmp_path, monkeypatch):
        pages = [tmp_path / "README.md", tmp_path / "docs" / "cameras.md"]
        pages[1].parent.mkdir()
        for page in pages:
            page.write_text(f"# Title\n{report.BEGIN}\nas it was\n{report.END}\nrest\n")
        found = [outcome(worst, name) for name in NAMES]
        monkeypatch.setattr(command, "ROOT", tmp_path)
        monkeypatch.setattr(command, "outcomes", lambda names, count: found)
        assert command.main(["--document"]) == status
        for page in pages:
            text = page.read_text()
            assert text.startswith("# Title\n") and text.endswith("\nrest\n")
            assert ("as it was" in text) == bool(status)
            assert ("`gltf`" in text) == (not status)
