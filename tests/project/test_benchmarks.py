"""The benchmarks' parts that need no peers: meshes, cameras, tables, files. No stopwatch."""

from __future__ import annotations

import json
import math
from importlib import import_module

import numpy as np
import pytest

from renderer.errors import LucidaError
from renderer.scene import flatten
from tests.benchmarks import __main__ as command
from tests.benchmarks import cameras, measure, plot, report, run, scenes
from tests.benchmarks.tables import TABLES, build, cancel, memory, moving, window

SIZE = (32, 18)


def small():
    return scenes.SUBJECTS["small"]()


class TestMeshes:
    @pytest.mark.parametrize("make", [scenes.knot, scenes.bumpy_sphere, scenes.table_top])
    @pytest.mark.parametrize("triangles", [600, 20_000])
    def test_about_as_many_triangles_as_wanted(self, make, triangles):
        _, faces = make(triangles)
        assert len(faces) == pytest.approx(triangles, rel=0.12)

    @pytest.mark.parametrize("make", [scenes.knot, scenes.bumpy_sphere, scenes.table_top])
    def test_closed_and_turned_outwards(self, make):
        vertices, faces = make(3000)
        edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        # Each edge is walked once in each direction: closed, and all faces turned alike.
        forth, counts = np.unique(edges, axis=0, return_counts=True)
        assert (counts == 1).all()
        assert (forth == np.unique(edges[:, ::-1], axis=0)).all()
        a, b, c = vertices[faces.T].astype(float)
        assert np.einsum("ij,ij->", a, np.cross(b, c)) > 0  # 6 times the volume

    def test_every_vertex_is_used(self):
        for make in (scenes.knot, scenes.bumpy_sphere):
            vertices, faces = make(2000)
            assert (np.unique(faces) == np.arange(len(vertices))).all()

    def test_every_direction_leaves_the_ball_once(self):
        vertices, faces = scenes.bumpy_sphere(5000)
        a, b, c = vertices[faces.T].astype(float)
        # Star-shaped: seen from the centre, all faces are turned away.
        assert (np.einsum("ij,ij->i", a, np.cross(b, c)) > 0).all()

    def test_a_model_file_is_one_mesh(self, tmp_path):
        file = tmp_path / "one.obj"
        file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        subject = scenes.model(file)
        assert (subject.name, subject.triangles) == ("one.obj", 1)

    def test_many_objects_share_the_triangles(self):
        scene = scenes.many_objects(7000, 27)
        assert len(scene.objects) == 27
        assert len(flatten(scene).faces) == pytest.approx(7000, rel=0.15)

    def test_moving_changes_one_object(self):
        scene = scenes.many_objects(2000, 8)
        moved = moving.moved_object(scene, 1)
        same = [a is b for a, b in zip(scene.objects, moved.objects, strict=True)]
        assert same.count(False) == 1
        number = same.index(False)
        before, after = scene.objects[number].shape, moved.objects[number].shape
        assert (before.transform != after.transform).any()
        # As it is for the tracer, which keeps what it built of them.
        assert before.vertices is after.vertices
        assert before.faces is after.faces


class TestCameras:
    @pytest.mark.parametrize("number", range(3))
    def test_rays_are_the_cameras(self, number):
        camera = cameras.easy_views(small(), SIZE)[number].camera
        origins, directions = cameras.rays(camera, SIZE)
        exact = camera.rays(SIZE)
        assert origins.dtype == directions.dtype == np.float32
        np.testing.assert_allclose(origins, exact.origin.reshape(-1, 3), atol=1e-5)
        np.testing.assert_allclose(directions, exact.direction.reshape(-1, 3), atol=1e-6)

    def test_the_skewed_view_is_skewed(self):
        u, v, w = cameras.easy_views(small(), SIZE)[2].camera.basis.T
        assert min(abs(u @ v), abs(v @ w), abs(w @ u)) > 0.01

    @pytest.mark.parametrize("name", ["small", "ball 4k"])
    def test_all_views_see_the_subject(self, name):
        subject = scenes.SUBJECTS[name]()
        for view in cameras.easy_views(subject, SIZE) + cameras.hard_views(subject, SIZE):
            at = view.camera.project(subject.vertices, view.size)
            inside = (at.row > 0) & (at.row < SIZE[1]) & (at.column > 0) & (at.column < SIZE[0])
            assert inside.any(), view.name

    def test_random_cameras_stay_inside(self):
        ball = scenes.SUBJECTS["ball 4k"]()
        rng = np.random.default_rng(1)
        for _ in range(20):
            camera = cameras.random_inside(ball, SIZE, rng)
            assert np.linalg.norm(camera.eye) < 0.5 * np.linalg.norm(ball.vertices, axis=1).min()


class TestMeasure:
    def test_quartiles(self):
        timing = measure.Timing((4.0, 1.0, 2.0, 3.0, 5.0))
        assert (timing.low_s, timing.median_s, timing.high_s) == (2.0, 3.0, 4.0)
        assert timing.numbers()["samples"] == 5

    def test_calls_take_turns(self):
        order: list[str] = []
        calls = {name: lambda name=name: order.append(name) for name in "ab"}
        plan = measure.Plan(rounds=2, warm_s=-1.0, repeats=2, slow_s=math.inf, budget_s=math.inf)
        timings = measure.interleaved(calls, plan)
        # One call of each first; then in each round an untimed and two timed ones.
        assert "".join(order) == "ab" + "aaabbb" * 2
        assert {len(timing.samples_s) for timing in timings.values()} == {4}

    def test_slow_calls_have_one_sample_a_round(self):
        plan = measure.Plan(rounds=3, repeats=5, slow_s=-1.0, budget_s=math.inf)
        assert len(measure.interleaved({"a": lambda: None}, plan)["a"].samples_s) == 3

    def test_the_budget_ends_the_rounds(self):
        plan = measure.Plan(rounds=9, repeats=1, slow_s=math.inf, budget_s=-1.0, least_rounds=2)
        assert len(measure.interleaved({"a": lambda: None}, plan)["a"].samples_s) == 2


def table():
    made = report.Table("speed", "Speed of things", ("thing", "ms", "times"))
    fast, slow = measure.Timing((0.0051, 0.005, 0.0049)), measure.Timing((0.0123,))
    made.add("ours", report.ms(fast), "1.00x", thing="ours", **fast.numbers())
    made.add("theirs", report.ms(slow), report.times(2.46), thing="theirs", **slow.numbers())
    made.notes.append("A note.")
    made.target("ratio", 2.46, 2.0, "x")
    made.target("wait", 3.0, 2.0, "ms", at_least=False)
    made.target("nothing", math.nan, 2.0, "x")
    return made


class TestReport:
    def test_targets(self):
        assert [target.met for target in table().targets] == [True, False, False]

    def test_numbers_have_three_digits(self):
        numbers = (0.01234, 1.234, 12.34, 123.4, math.nan)
        assert [report.short(n) for n in numbers] == ["0.012", "1.23", "12.3", "123", "-"]

    def test_text_is_aligned(self):
        lines = report.text(table()).splitlines()
        assert lines[0] == "Speed of things  [speed]"
        assert lines[2:6] == [
            "  thing                    ms  times",
            "  ------  -------------------  -----",
            "  ours    5.00 (4.95 to 5.05)  1.00x",
            "  theirs  12.3 (12.3 to 12.3)  2.46x",
        ]
        assert "  A note." in lines
        assert any(line.endswith("falls short") and "at most 2 ms" in line for line in lines)

    def test_markdown_has_a_row_a_row(self):
        text = report.markdown(table())
        assert "| thing | ms | times |\n| --- | ---: | ---: |\n| ours |" in text
        assert report.targets_markdown([table()]).count("falls short") == 2

    def test_a_row_must_fit_the_header(self):
        with pytest.raises(ValueError, match="2 cells under 3 headings"):
            table().add("a", "b")

    def test_json(self):
        text = report.as_json([table()], report.machine(), {"quick": True}, {}, {"x": "missing"})
        whole = json.loads(text)
        assert whole["format"] == report.FORMAT
        assert set(whole) == {"format", "machine", "settings", "peers", "left_out", "tables"}
        (made,) = whole["tables"]
        assert [row["thing"] for row in made["data"]] == ["ours", "theirs"]
        assert made["data"][0]["median_s"] == 0.005
        assert [target["met"] for target in made["targets"]] == [True, False, False]
        assert made["targets"][2]["measured"] is None
        assert {"cpu", "processors", "python", "packages"} <= set(whole["machine"])

    def test_only_what_is_between_the_marks_changes(self):
        old = f"before\n{report.BEGIN}\nold\n{report.END}\nafter\n"
        new = report.between_marks(old, "new\n")
        assert new == f"before\n{report.BEGIN}\nnew\n{report.END}\nafter\n"
        assert report.between_marks(new, "new") == new

    @pytest.mark.parametrize("text", ["", report.BEGIN, f"{report.END}{report.BEGIN}"])
    def test_missing_marks_are_named(self, text):
        with pytest.raises(LucidaError, match="bench:begin"):
            report.between_marks(text, "new")


class TestTables:
    def test_each_has_a_module(self):
        for name in TABLES:
            assert callable(import_module(f"tests.benchmarks.tables.{name}").measure)

    def test_counts_in_the_picture(self):
        numbers = (4276, 70_006, 921_600, 1_000_182)
        assert [plot.short_count(n) for n in numbers] == ["4.28k", "70k", "922k", "1M"]

    def test_the_windows_row(self):
        made = report.Table("window", "", tuple("abcdefghi"))
        measured = window.Measured(
            size=(1280, 720),
            drag_starts_s=[0.0, 0.016, 0.032, 0.064],
            drag_work_s=[0.002, 0.010, 0.020, 0.004],
            drag_images=2,
            first_s=[0.03, 0.04],
            first_frames=[1, 2],
            first_factors=[1, 1],
            full_s=[],
            full_frames=[],
        )
        window.add_row(made, "small", measured)
        assert made.rows[0][:4] == ("small", "1280x720", "4", "1 (25.0 %)")
        assert made.rows[0][4] == "16.0"
        assert made.rows[0][6:] == ("31.2", "35.0 (1.50)", "- (-)")
        # What never came is not met.
        assert [target.met for target in made.targets] == [False, False, False]
        json.loads(report.as_json([made], {}, {}, {}, {}))

    def test_bytes_of_the_mesh(self):
        ball = scenes.SUBJECTS["ball 4k"]()
        assert memory.mesh_bytes(ball) == 12 * (len(ball.vertices) + len(ball.faces))


class TestPeers:
    @pytest.mark.parametrize(
        ("message", "package"),
        [
            ("libusb-1.0.so.0: cannot open shared object file", "libusb-1.0-0"),
            ('the LLVM shared library ("libLLVM.so") could not be found', "libllvm"),
            ("LLVM is missing", "libllvm"),
            ("libGL.so.1: cannot open shared object file", "libgl1"),
        ],
    )
    def test_a_missing_library_is_named_with_its_package(self, message, package):
        assert f"install the system's {package}" in run.reason(ImportError(message))

    def test_other_reasons_stay_as_they_are(self):
        assert run.reason(ImportError("No module\nnamed 'x'")) == "No module named 'x'"
        assert run.reason(RuntimeError()) == "RuntimeError"

    def test_a_broken_peer_is_left_out(self, monkeypatch):
        class Broken(run.Lucida):
            name = "Broken"

            def __init__(self):
                raise ImportError("No module named 'broken'")

        monkeypatch.setattr(run, "PEERS", (Broken,))
        session = run.Run()
        session.find_peers()
        assert session.kinds == ()
        assert session.left_out == {"Broken": "No module named 'broken'"}


class TestCommand:
    def test_unknown_tables_are_named(self, capsys):
        assert command.main(["--only", "visibility,speed"]) == 2
        assert "--only: 'speed' is unknown; give one of visibility" in capsys.readouterr().err

    def test_tables_are_written_as_json(self, tmp_path, monkeypatch, capsys):
        monkeypatch.setattr(build, "measure", lambda session: [table()])
        arguments = ["--only", "build", "--quick", "--no-peers", "--out", str(tmp_path / "out")]
        assert command.main(arguments) == 0
        whole = json.loads((tmp_path / "out" / "bench.json").read_text())
        assert [made["name"] for made in whole["tables"]] == ["speed"]
        assert whole["settings"]["quick"] is True
        assert "falls short" in capsys.readouterr().out

    def test_a_table_that_fails_leaves_the_others(self, tmp_path, monkeypatch, capsys):
        def broken(session):
            raise RuntimeError("out of luck")

        monkeypatch.setattr(build, "measure", broken)
        monkeypatch.setattr(cancel, "measure", lambda session: [table()])
        arguments = ["--only", "build,cancel", "--no-peers", "--out", str(tmp_path)]
        assert command.main(arguments) == 1
        assert "out of luck" in capsys.readouterr().err
        assert len(json.loads((tmp_path / "bench.json").read_text())["tables"]) == 1

    def test_the_page_needs_all_tables(self, capsys):
        assert command.main(["--document", "--only", "build", "--no-peers"]) == 2
        assert "--document: needs all tables" in capsys.readouterr().err

    def test_the_page_s_block_is_replaced(self, tmp_path, monkeypatch):
        monkeypatch.setattr(command, "ROOT", tmp_path)
        monkeypatch.setattr(command, "DOCUMENTED", ("speed",))
        monkeypatch.setattr(command, "TABLES", ("build",))
        monkeypatch.setattr(build, "measure", lambda session: [table()])
        monkeypatch.setattr(command.plot, "draw", lambda tables, path: True)
        page = tmp_path / "docs" / "speed.md"
        page.parent.mkdir()
        page.write_text(f"# Title\n{report.BEGIN}\nold\n{report.END}\nrest\n")
        assert command.main(["--document", "--no-peers", "--out", str(tmp_path / "out")]) == 0
        text = page.read_text()
        assert text.startswith("# Title\n")
        assert text.endswith(f"{report.END}\nrest\n")
        assert "old" not in text
        for part in ("(bench.png)", "| ours |", "| ratio | at least 2 x | 2.46 x | met |"):
            assert part in text

    def test_what_was_measured_before_ctrl_c_is_written(self, tmp_path, monkeypatch):
        def stopped(session):
            raise KeyboardInterrupt

        monkeypatch.setattr(build, "measure", lambda session: [table()])
        monkeypatch.setattr(cancel, "measure", stopped)
        arguments = ["--only", "build,cancel", "--no-peers", "--out", str(tmp_path)]
        assert command.main(arguments) == 0
        assert len(json.loads((tmp_path / "bench.json").read_text())["tables"]) == 1
