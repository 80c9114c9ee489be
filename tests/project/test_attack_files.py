"""The attack with damaged files: it runs, and it notices what it is there for."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MODULE = "tests.attack.mutated_files"

NOTICES = """
import json, os, sys, time
from pathlib import Path
import tests.attack.mutated_files as attack
attack.TIME_S = 1
def crash(path): os.abort()
def hang(path): time.sleep(60)
def fill(path):
    try:
        return str(len(bytearray(4 << 30)))
    except MemoryError:
        return "took more memory than it may"
def nothing(path): os._exit(0)
answers = []
for attack.read in (crash, hang, fill, nothing):
    answers.append(attack.read_apart(Path("x.obj")))
print(json.dumps(answers))
"""

JUDGES = """
import json
from pathlib import Path
import tests.attack.mutated_files as attack
from renderer.errors import LucidaError
def of(error):
    def load(path):
        raise error
    attack.load_scene = load
    return attack.read(Path("x.obj"))
print(json.dumps([
    of(LucidaError("a", "is wrong", "mend it")),
    of(LucidaError("a", "is wrong")),
    of(LucidaError("", "does not fit into memory", "give less")),
    of(LucidaError("", "is wrong", "mend it", "x" * 5000)),
    of(ZeroDivisionError("oh")),
    of(RuntimeWarning("oh")),
]))
"""


def run(*arguments: str) -> str:
    result = subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=240
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def test_no_damaged_file_does_harm() -> None:
    out = run("-m", MODULE, "--files", "40", "--seed", "11")
    assert out.startswith("40 mutated files: ")
    assert "refused" in out
    assert "wrong" not in out


@pytest.mark.skipif(not hasattr(os, "fork"), reason="without fork there are no limits")
def test_crashes_hangs_and_memory_are_noticed() -> None:
    assert json.loads(run("-c", NOTICES)) == [
        "crashed: SIGABRT",
        "took more than 1 s",
        "took more memory than it may",
        "said nothing",
    ]


def test_what_is_no_proper_refusal_is_noticed() -> None:
    answers = json.loads(run("-c", JUDGES))
    assert answers[0] == "refused"
    assert [answer.split()[0] for answer in answers[1:]] == [
        "no",
        "took",
        "a",
        "ZeroDivisionError:",
        "RuntimeWarning:",
    ]
