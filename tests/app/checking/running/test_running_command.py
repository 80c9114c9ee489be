"""Programs in any language: a line of JSON for each call, a line of JSON from each."""

from __future__ import annotations

import sys
import threading

import pytest
from students import CAMERA, called
from waiting import wait_for

from lucida.app.checking.running.command import CommandStudent
from lucida.app.checking.tasks import Limits
from lucida.renderer.system.errors import LucidaError

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="shells and C as POSIX has them")
CALLS = [called("viewing_ray", i=i, j=j, camera=CAMERA) for i in range(48) for j in range(64)]


@pytest.fixture
def program(tmp_path):
    """Makes a student of a Python program's text, which is run by a command."""
    made = []

    def make(source: str, **limits) -> CommandStudent:
        path = tmp_path / "my rays.py"
        path.write_text(f"import json, os, sys, time\n{source}\n", "utf-8")
        command = f'"{sys.executable}" -I "{path}"'
        made.append(CommandStudent(command, Limits(**{"seconds": 60, **limits})))
        return made[-1]

    yield make
    for one in made:
        one.close()


def test_a_program_is_given_the_calls_by_name(program):
    one = program("for line in sys.stdin: print(json.dumps([json.loads(line)]))")
    first = called("viewing_ray", i=1, j=2.5, camera=CAMERA)
    assert one.functions() is None
    values = one.call([first, called("basis", up=[0, 1, 0])]).values
    assert values == (
        [{"function": "viewing_ray", "i": 1, "j": 2.5, "camera": CAMERA}],
        [{"function": "basis", "up": [0, 1, 0]}],
    )
    assert one.call([first]).values == values[:1]


ANSWERING = {
    "line by line": "for line in sys.stdin: print(line, end='', flush=True)",
    "blank lines": "for line in sys.stdin: print(line, end='\\n  \\r\\n\\n')",
    "never ends": "for line in sys.stdin: print(line, end='', flush=True)\ntime.sleep(10**6)",
    "status": "print(sys.stdin.read(), end='')\nsys.exit(3)",
}


@pytest.mark.parametrize("name", ANSWERING)
def test_whenever_a_program_answers(program, name):
    run = program(ANSWERING[name]).call(CALLS)
    assert run.failure is None
    assert len(run.values) == len(CALLS)
    assert run.values[-1]["i"] == 47


FAULTS = {
    "status": (
        "print(1); sys.exit(7)",
        1,
        "ended",
        "ended with exit status 7, with 1 of 4 answers",
    ),
    "text": ("print('1\\nhello')", 1, "answer", "answer 2 is no JSON: hello;"),
    "closed": ("os.close(1); time.sleep(10**6)", 0, "ended", "closed what it answers through"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_a_program_does_wrong_is_told_in_one_line(program, name):
    source, answered, kind, told = FAULTS[name]
    run = program(source).call([called("f", i=i) for i in range(4)])
    assert len(run.values) == answered
    assert run.failure.kind == kind
    assert told in run.failure.text
    assert run.failure.call == answered
    assert "\n" not in run.failure.text
    assert len(run.failure.text) < 400


def test_a_program_without_end(program):
    source = "while True: pass"
    failure = program(source, seconds=0.5).call(CALLS).failure
    assert failure.kind == "time"
    assert "the time limit of 0.5 s is over, with " in failure.text
    assert "of 3072 answers; does it read to the end of its input" in failure.text


def test_a_stop_from_another_thread(program, tmp_path):
    begun = tmp_path / "begun"
    one = program(f"print(1, flush=True)\nopen({str(begun)!r}, 'w').close()\nwhile True: pass")
    runs = []
    thread = threading.Thread(target=lambda: runs.append(one.call(CALLS)))
    thread.start()
    wait_for(begun.exists)
    one.stop()
    thread.join()
    assert runs[0].failure.kind == "ended"
    assert "it was stopped, with 1 of 3072 answers" in runs[0].failure.text
    one.close()
    assert "it is closed" in one.call(CALLS).failure.text


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ('""', "is no command; name a program"),
        ("julia 'rays.jl", "No closing quotation; close the quotes"),
        ("a\0b", "is no command"),
    ],
)
def test_what_is_no_command(command, told):
    if sys.platform == "win32" and "'" in command:
        pytest.skip("no quotes there")
    with pytest.raises(LucidaError, match=told):
        CommandStudent(command)


@POSIX
def test_programs_that_cannot_be_started(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lost").write_text("#!/no/such/thing\n", "utf-8")
    (tmp_path / "lost").chmod(0o755)
    for command, told in {
        "no-such-program-at-all -x": "no-such-program-at-all: there is no such program; is it",
        "./lost": "lost: it ended with exit status 127, with 0 of 1 answers",
    }.items():
        failure = CommandStudent(command).call([called("f")]).failure
        assert failure is not None and told in failure.text
