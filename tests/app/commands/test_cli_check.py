"""`lucida check` and `lucida tasks`: exit statuses, reports, and what is said of mistakes."""

from __future__ import annotations

import json
import sys

import pytest
from both_lectures import both_lectures

from lucida.app.checking.task_file import BUILTIN
from lucida.app.cli import main

RIGHT = """\
def hit_sphere(origin, direction, center, radius):
    def dot(a, b):
        return sum(x * y for x, y in zip(a, b))
    away = [x - y for x, y in zip(origin, center)]
    a, b, c = dot(direction, direction), dot(away, direction), dot(away, away) - radius**2
    root = max(0, b * b - a * c) ** 0.5
    found = [t for t in ((-b - root) / a, (-b + root) / a) if root > 0 and t > 0]
    return min(found, default=None)
"""
WRONG = RIGHT.replace("min(found", "max(found")
RAISES = RIGHT.replace("away = ", "away = 1 / 0, ")
ALSO = """
def hit_triangle(origin, direction, a, b, c):
    print("called")
    return 1.5
"""
TASKS = """\
feedback = "{feedback}"
[[tasks]]
kind = "hit-sphere"
points = 2
[[tasks]]
kind = "hit-triangle"
points = 3
"""


@pytest.fixture
def check(tmp_path, capsys, monkeypatch):
    """Runs `lucida check` with a file of this text; the status, what was printed, and errors."""
    monkeypatch.chdir(tmp_path)

    def run(text, *words):
        if text is not None:
            (tmp_path / "answer.py").write_text(text, "utf-8")
            words = ("answer.py", *words)
        status = main(["check", *words])
        told = capsys.readouterr()
        return status, told.out, told.err

    return run


def test_right_is_0_wrong_is_1_and_what_cannot_run_is_2(check):
    status, out, err = check(RIGHT)
    assert (status, out) == (0, "correct hit-sphere  2 of 2 points\n")
    assert err.startswith("lucida: The program has your rights") and err.count("\n") == 1
    status, out, _ = check(WRONG)
    assert status == 1
    assert out.startswith("wrong   hit-sphere  0 of 2 points\n")
    assert "hit_sphere(p=(0, 0, 5), d=(0, 0, -1), center=(0, 0, 0), radius=1)\n" in out
    assert "correct: 4\n" in out and "given: 6\n" in out
    status, out, _ = check(RAISES)
    assert status == 2
    assert out.startswith("failed  hit-sphere") and "ZeroDivisionError" in out
    assert "hit_sphere(p=(0, 0, 5), d=(0, 0, -1), center=(0, 0, 0), radius=1)" in out


def test_several_tasks_are_told_in_their_order_with_a_sum(check):
    status, out, _ = check(WRONG + ALSO)
    heads = [line for line in out.splitlines() if not line.startswith(" ")]
    assert status == 1
    assert [line.split()[1] for line in heads[:2]] == ["hit-sphere", "hit-triangle"]
    assert heads[2] == "0 of 2 tasks correct, 0 of 4 points"
    status, out, _ = check(RAISES + ALSO)
    assert status == 2 and out.count("wrong ") == 1


def test_a_file_with_none_of_the_functions(check):
    status, out, err = check("def other():\n    pass\n")
    assert (status, out) == (2, "")
    assert "lucida: answer.py: it has none of the requested functions" in err and "basis" in err


def test_a_named_task_must_be_there(check, tmp_path):
    status, out, _ = check(RIGHT, "--task", "hit-triangle")
    assert status == 2 and "there is no function hit_triangle" in out
    status, _, err = check(RIGHT, "--task", "hit-triangel")
    assert status == 2 and "did you mean 'hit-triangle'" in err
    status, out, _ = check(RIGHT + ALSO, "--task", "hit_sphere")
    assert status == 0 and out.count("\n") == 1
    (tmp_path / "hw.toml").write_text('[[tasks]]\nkind = "hit-sphere"\nfunction = "place"\n')
    renamed = RIGHT.replace("hit_sphere", "place")
    assert check(renamed, "--tasks", "hw.toml", "--task", "place")[0] == 0


def test_a_file_that_does_not_run(check, tmp_path):
    status, _, err = check("def f(:\n", "--json", "r.json")
    assert status == 2 and err.splitlines()[-1].startswith("lucida: answer.py, line 1")
    values = json.loads((tmp_path / "r.json").read_text())
    assert values["score"] == 0 and "line 1" in values["output"]
    assert len(values["tests"]) == len(BUILTIN)
    assert all("line 1" in test["output"] for test in values["tests"])
    status, _, err = check(None, "nowhere.py", "--json", "r.json")
    assert status == 2 and "nowhere.py" in err
    assert "nowhere.py" in json.loads((tmp_path / "r.json").read_text())["output"]


def test_a_file_that_fails_while_it_is_imported(check, tmp_path):
    text = "print('so far')\ndef help():\n    return 1 / 0\nhelp()\n" + RIGHT
    status, out, err = check(text, "--json", "r.json")
    assert (status, out) == (2, "") and "ZeroDivisionError" in err.splitlines()[-1]
    assert "return 1 / 0" in err and "so far" in err
    told = json.loads((tmp_path / "r.json").read_text())["output"]
    assert "return 1 / 0" in told and "so far" in told


def test_what_was_printed_is_shown(check):
    text = RIGHT.replace("    away", "    print('radius', radius)\n    away")
    status, out, _ = check(text)
    lines = out.splitlines()
    assert status == 0 and lines[1:3] == ["        printed:", "          radius 1.0"]
    assert lines[-1] == "          ... and 22 lines more"


@pytest.mark.parametrize("feedback", ["nothing", "verdict", "first-wrong", "diagnosis"])
def test_no_more_is_told_than_the_feedback_says(check, tmp_path, feedback):
    (tmp_path / "hw.toml").write_text(TASKS.format(feedback=feedback))
    status, out, _ = check(RIGHT + ALSO, "--tasks", "hw.toml", "--json", "r.json")
    text = (tmp_path / "r.json").read_text()
    values = json.loads(text)
    assert status == 1 and values["score"] == 2.0
    told = ("wrong" in out, "given: 1.5" in out)
    shown = ["visible" if feedback != "nothing" else "hidden"] * 2
    assert [test["visibility"] for test in values["tests"]] == shown
    if feedback == "nothing":
        assert told == (False, False) and out.startswith(
            "tried   hit-sphere\ntried   hit-triangle\n2 tasks were"
        )
        assert "given" not in text and "right" not in text
    elif feedback == "verdict":
        assert told == (True, False) and "given" not in text and "center=" not in text
    else:
        assert told == (True, True) and "given: 1.5" in text


def test_a_starter_is_never_written_over_another_file(check, tmp_path):
    status, out, _ = check(None, "--starter", "viewing-ray", "-o", "rays.py")
    assert (status, out) == (0, "rays.py: viewing_ray\n")
    text = (tmp_path / "rays.py").read_text("utf-8")
    assert "def viewing_ray(i, j, W, H, camera):" in text and "parallel" in text
    assert text.isascii() and max(map(len, text.splitlines())) <= 100
    status, _, err = check(None, "--starter", "viewing-ray", "-o", "rays.py")
    assert status == 2 and "rays.py: -o: is there already" in err
    assert (tmp_path / "rays.py").read_text("utf-8") == text
    status, out, _ = check(None, "rays.py")
    assert status == 2 and "returned None" in out
    status, _, err = check(None, "--starter", "project")
    assert status == 2 and err.startswith("lucida: --starter: 'project' is unknown")
    status, out, _ = check(None, "--starter", "viewing-ray")
    assert (status, out) == (0, text)
    assert main(["check", "--starter", "all", "-o", "all.py"]) == 0
    compile((tmp_path / "all.py").read_text("utf-8"), "all.py", "exec")
    assert (tmp_path / "all.py").read_text("utf-8").count("\ndef ") == 6


def test_a_program_is_checked_on_the_task_that_is_named(check, tmp_path):
    program = tmp_path / "answers.py"
    program.write_text(
        f"import json, sys\n{RIGHT}\n"
        "for line in sys.stdin:\n"
        "    asked = json.loads(line)\n"
        "    asked.pop('function')\n"
        "    print(json.dumps(hit_sphere(**asked)))\n"
    )
    command = f'"{sys.executable}" answers.py'
    assert check(None, "--command", command, "--task", "hit-sphere")[0] == 0
    status, _, err = check(None, "--command", command)
    assert status == 2 and "--task: is missing" in err
    status, _, err = check(RIGHT, "--command", command, "--task", "hit-sphere")
    assert status == 2 and "argument --command: not allowed with argument FILE" in err
    status, _, err = check(None)
    assert status == 2 and "one of the arguments FILE --command --starter is required" in err


@pytest.mark.skipif(sys.platform != "linux", reason="Linux limits memory")
def test_a_task_file_has_limits(check, tmp_path):
    (tmp_path / "hw.toml").write_text("memory_mb = 99\n" + TASKS.format(feedback="verdict"))
    text = "def hit_sphere(*_):\n    bytearray(10**9)\n" + ALSO
    status, out, _ = check(text, "--tasks", "hw.toml")
    assert status == 2 and "limit of 99 MB" in out and "wrong   hit-triangle" in out


def test_the_list_of_tasks(capsys, tmp_path):
    assert main(["tasks"]) == 0
    tasks, _, courses = capsys.readouterr().out.partition("\n\n")
    assert [line.split()[0] for line in tasks.splitlines()] == [task.name for task in BUILTIN]
    assert "--tasks" in courses and "pbrt" in courses
    assert main(["tasks", "viewing-ray"]) == 0
    out = capsys.readouterr().out
    assert "camera.e: the camera's position" in out and "In the lecture: Any camera." in out
    (tmp_path / "hw.toml").write_text(TASKS.format(feedback="verdict"))
    assert main(["tasks", "--tasks", str(tmp_path / "hw.toml")]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 2
    assert main(["tasks", "rays"]) == 2
    assert capsys.readouterr().err.startswith("lucida: NAME: 'rays' is unknown; ")


def test_lecture_parts_are_steps_of_the_lecture():
    titles = {step.title for step in both_lectures().steps}
    assert {task.part for task in BUILTIN} <= titles
