"""The benchmarks' tables, targets and files. No stopwatch."""

from __future__ import annotations

import json
import math
from importlib import import_module

import pytest

from renderer.errors import LucidaError
from tests.benchmarks import __main__ as command
from tests.benchmarks import measure, report, run
from tests.benchmarks.tables import TABLES, build, cancel, window


class TestMeasure:
    def test_quartiles(self):
        timing = measure.Timing((4.0, 1.0, 2.0, 3.0, 5.0), (9.0, 7.0, 8.0))
        assert (timing.low_s, timing.median_s, timing.high_s) == (2.0, 3.0, 4.0)
        assert timing.numbers()["samples"] == 5
        assert timing.numbers()["first_s"] == 8.0

    def test_a_turn_is_calls_after_a_pause(self, monkeypatch):
        order: list[str] = []
        monkeypatch.setattr(measure.time, "sleep", lambda pause_s: order.append(f"{pause_s} s"))
        times = iter((0.03, 0.01, 0.02))

        def stopwatch(call):
            call()
            return next(times)

        plan = measure.Plan(pause_s=0.5, repeats=3, slow_s=1.0)
        assert measure.turn(lambda: order.append("call"), plan, stopwatch) == (0.03, 0.01, 0.02)
        assert order == ["0.5 s", "call", "call", "call"]

    def test_slow_calls_are_called_once_a_turn(self):
        plan = measure.Plan(pause_s=0.0, repeats=5, slow_s=1.0)
        assert measure.turn(lambda: None, plan, lambda call: 1.5) == (1.5,)

    def test_turns_alternate_and_the_first_round_does_not_count(self):
        order: list[str] = []

        def own(name):
            def turn():
                order.append(name)
                return (9.0,) if order.count(name) == 1 else (3.0, 1.0, 2.0)

            return turn

        plan = measure.Plan(rounds=2, budget_s=math.inf)
        timings = measure.interleaved({name: own(name) for name in "ab"}, plan)
        assert "".join(order) == "ab" * 3
        assert timings["a"] == timings["b"] == measure.Timing((2.0, 2.0), (3.0, 3.0))

    def test_the_budget_ends_the_rounds(self):
        plan = measure.Plan(rounds=9, budget_s=-1.0, least_rounds=2)
        timings = measure.interleaved({"a": lambda: (1.0,)}, plan)
        assert timings["a"].samples_s == (1.0, 1.0)


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
        assert report.markdown(report.targets([table()])).count("falls short") == 2

    def test_where_a_peer_is_faster(self):
        made = report.Table("speed", "", ("scene", "pixels", "Lucida ms (quartiles)", "A ms", "B"))
        for view, *all_ms in (("70", 2, 3, 4), ("1,280", 2, 1.5, 1), ("9.5", 2, 2, 2)):
            own = zip(("Lucida", "A", "B"), all_ms, strict=True)
            timings = {name: measure.Timing((ms / 1e3,)) for name, ms in own}
            ratios = made.compare("ball", view, timings=timings)
            assert ratios == pytest.approx({"A": all_ms[1] / 2, "B": all_ms[2] / 2})
        assert made.rows[0] == ("ball", "70", "2.00 (2.00 to 2.00)", "3.00 (1.50x)", "4.00 (2.00x)")
        rows = report.losses([table(), made]).rows
        assert rows == [("speed, ball, pixels 1,280", "B", "1.00", "2.00")]

    def test_missed_targets_are_repeated(self):
        names = ["ratio", "wait", "nothing"]
        assert [row[0] for row in report.targets([table()]).rows] == names
        assert [row[0] for row in report.targets([table()], missed=True).rows] == names[1:]

    def test_a_row_must_fit_the_header(self):
        with pytest.raises(ValueError, match="2 cells under 3 headings"):
            table().add("a", "b")

    def test_json(self):
        text = report.as_json([table()], machine=report.machine(), peers={})
        whole = json.loads(text)
        assert set(whole) == {"format", "machine", "peers", "tables"}
        (made,) = whole["tables"]
        assert [row["thing"] for row in made["data"]] == ["ours", "theirs"]
        assert made["data"][0]["median_s"] == 0.005
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

    def test_the_windows_row(self):
        made = report.Table("window", "", tuple("abcdefghij"))
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
        case = window.CASES[1]
        window.add_row(made, "small", case, measured)
        name = "1280x720, outside view"
        assert made.rows[0][:5] == ("small", name, "1280x720", "4", "1 (25.0 %)")
        assert made.rows[0][5] == "16.0"
        assert made.rows[0][7:] == ("31.2", "35.0 (1.50)", "- (-)")
        # What never came is not met.
        assert [target.met for target in made.targets] == [False, False, False]
        # A mesh from a file has no targets but one.
        window.add_row(made, "bunny", case, measured)
        assert len(made.targets) == 4


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
        page = tmp_path / "docs" / "speed.md"
        page.parent.mkdir()
        page.write_text(f"# Title\n{report.BEGIN}\nold\n{report.END}\nrest\n")
        assert command.main(["--document", "--no-peers", "--out", str(tmp_path / "out")]) == 0
        text = page.read_text()
        assert text.startswith("# Title\n")
        assert text.endswith(f"{report.END}\nrest\n")
        assert "old" not in text
        for part in ("| ours |", "| ratio | at least 2 x | 2.46 x | met |"):
            assert part in text

    def test_what_was_measured_before_ctrl_c_is_written(self, tmp_path, monkeypatch):
        def stopped(session):
            raise KeyboardInterrupt

        monkeypatch.setattr(build, "measure", lambda session: [table()])
        monkeypatch.setattr(cancel, "measure", stopped)
        arguments = ["--only", "build,cancel", "--no-peers", "--out", str(tmp_path)]
        assert command.main(arguments) == 0
        assert len(json.loads((tmp_path / "bench.json").read_text())["tables"]) == 1
