"""`lucida check --json` as an autograder that knows only Gradescope's documentation reads it."""

from __future__ import annotations

from pathlib import Path

import pytest

from lucida.app.cli import main
from tests.support.mock_gradescope import Shown, published

RIGHT = """
def basis(eye, target, up):
    import numpy as np
    w = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    u = np.cross(up, w) / np.linalg.norm(np.cross(up, w))
    return u, np.cross(w, u), w
"""
WRONG = """
def basis(eye, target, up):
    return eye, target, up
"""
PRINTS = WRONG.replace("    return", '    print("eye \\x00 of", eye)\n    return')
RAISES = """
def basis(eye, target, up):
    raise ValueError(f"no {up[0]}")
"""
NOT_A_NUMBER = """
def basis(eye, target, up):
    return float("nan")
"""
TASKS = """
feedback = "{feedback}"
[[tasks]]
kind = "basis"
points = 2
[[tasks]]
kind = "hit-sphere"
points = 1
feedback = "diagnosis"
"""


def submitted(folder: Path, code: str, feedback: str = "diagnosis") -> tuple[int, Shown]:
    """Exit status, and what the student sees, of a submission: what run_autograder does."""
    (folder / "submission.py").write_text(code, "utf-8")
    (folder / "tasks.toml").write_text(TASKS.format(feedback=feedback), "utf-8")
    out = folder / "results.json"
    status = main(
        [
            *("check", str(folder / "submission.py")),
            *("--tasks", str(folder / "tasks.toml"), "--json", str(out)),
        ]
    )
    return status, published(out)


def test_right_and_a_function_that_is_missing(tmp_path: Path) -> None:
    status, shown = submitted(tmp_path, RIGHT)
    assert status == 2 and shown.score == 2.0
    (name, verdict, _), (_, missing, why) = shown.tests
    assert name.startswith("basis") and verdict == "passed"
    assert missing == "failed" and "hit_sphere" in why


def test_wrong_with_what_was_printed(tmp_path: Path) -> None:
    _, shown = submitted(tmp_path, PRINTS)
    assert shown.score == 0.0
    _, verdict, output = shown.tests[0]
    assert verdict == "failed" and "correct: " in output and "given: " in output
    assert "eye \\x00 of " in output


@pytest.mark.parametrize(
    ("code", "says"),
    [
        (RAISES, "ValueError: no "),
        (NOT_A_NUMBER, "basis"),
        ("def basis(:", "line 1"),
        ("import sys; sys.exit(3)", "3"),
    ],
)
def test_what_cannot_be_run_says_why(tmp_path: Path, code: str, says: str) -> None:
    status, shown = submitted(tmp_path, code)
    assert shown.score == 0.0 and len(shown.tests) == 2
    assert status in (1, 2) and says in shown.output + shown.tests[0][2]


def test_a_task_file_or_a_submission_that_is_none(tmp_path: Path) -> None:
    out = tmp_path / "results.json"
    code, tasks = tmp_path / "rays.py", tmp_path / "tasks.toml"
    code.write_text(RIGHT, "utf-8")
    tasks.write_text('[[tasks]]\nkind = "viewing-rya"\n', "utf-8")
    for asked in (
        ["check", str(code), "--tasks", str(tasks)],
        ["check", str(tmp_path / "none.py"), "--task", "basis"],
    ):
        assert main([*asked, "--json", str(out)]) == 2
        shown = published(out)
        assert shown.score == 0.0 and shown.output


def test_nothing_is_known_of_a_hidden_task(tmp_path: Path) -> None:
    told = []
    for code in (RIGHT, WRONG):
        _, shown = submitted(tmp_path, code, "nothing")
        assert shown.score is None
        assert [name.partition(":")[0] for name, *_ in shown.tests] == ["hit-sphere"]
        told.append(shown)
    assert told[0] == told[1]
