"""The attacks' own machinery. The attacks themselves are no tests: `make attack`."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.attack import forks, mutations
from tests.attack.__main__ import GRACE_S, MINUTES, commands, main
from tests.attack.mutants import compiled, mutants, spans

ROOT = Path(__file__).parents[2]
needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
SOURCE = '''\
"""A module."""
LIMIT = 3


class Thing:
    size: int = 2

    def grown(self, by: float = 1.5) -> float:
        """By so much."""
        if by < 0 or not self.size:
            raise ValueError(f"{by + 1} is wrong")
        return -(self.size + by)


def several(numbers, limit=LIMIT):
    assert numbers != 0
    return sorted(n for n in numbers if isinstance(n, int) and n > limit)
'''
# What Thing().grown(2.5) and several([1, 3, 4]) become by each change.
WANTED = {
    ("Thing.grown", "Lt -> LtE"): (-4.5, [4]),
    ("Thing.grown", "Lt -> GtE"): (None, [4]),
    ("Thing.grown", "0 -> 1"): (-4.5, [4]),
    ("Thing.grown", "Or -> And"): (-4.5, [4]),
    ("Thing.grown", "condition negated"): (None, [4]),
    ("Thing.grown", "statement removed"): (-4.5, [4]),
    ("Thing.grown", "returns None"): (None, [4]),
    ("Thing.grown", "without minus"): (4.5, [4]),
    ("Thing.grown", "Add -> Sub"): (0.5, [4]),
    ("several", "returns None"): (-4.5, None),
    ("several", "arguments exchanged"): (-4.5, None),
    ("several", "And -> Or"): (-4.5, [1, 3, 4]),
    ("several", "Gt -> GtE"): (-4.5, [3, 4]),
    ("several", "Gt -> LtE"): (-4.5, [1, 3]),
    ("several", "filter 0 negated"): (-4.5, [1, 3]),
}


def _result(call):
    try:
        return call()
    except (TypeError, ValueError):
        return None


def test_a_mutants_code_has_its_change_and_no_other(tmp_path):
    """Types, texts, errors' words and what runs at import stay as they are."""
    (tmp_path / "thing.py").write_text(SOURCE)
    results = {}
    for mutant in mutants(tmp_path, "thing.py"):
        space: dict = {}
        exec(compiled(tmp_path, mutant), space)
        results[mutant.function, mutant.text.split(" | ")[1]] = (
            _result(lambda: space["Thing"]().grown(2.5)),  # noqa: B023
            _result(lambda: space["several"]([1, 3, 4])),  # noqa: B023
        )
    assert results == WANTED
    assert spans(tmp_path, "thing.py") == {"Thing.grown": range(8, 13), "several": range(15, 18)}


@needs_fork
def test_unnoticed_mutants_are_reported(tmp_path):
    (tmp_path / "app" / "halves").mkdir(parents=True)
    (tmp_path / "tests" / "halves").mkdir(parents=True)
    (tmp_path / "app/halves/halved.py").write_text(
        "def half(x):\n    return x / 2\n\n\ndef third(x):\n    return x / 3\n"
    )
    (tmp_path / "tests/halves/test_halved.py").write_text(
        "from app.halves import halved\n\n\ndef test():\n    assert halved.half(4) == 2\n"
        "    assert halved.third(0) == 0\n"
    )
    program = (
        "import sys; from pathlib import Path; import app\n"
        f"root = Path({str(tmp_path)!r}); app.__path__.append(str(root / 'app'))\n"
        "from tests.attack import mutations; mutations.ROOT = root\n"
        "sys.exit(mutations.main(['--room', 'app/halves']))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, timeout=200, capture_output=True, text=True
    )
    *survivors, room, total = done.stdout.splitlines()
    assert done.returncode == 0, done.stderr  # so few mutants are no share
    assert [line.split(" | ")[1] for line in sorted(survivors)] == [
        "3 -> 4 (1 tests pass)", "Div -> Mult (1 tests pass)"
    ]  # fmt: skip
    assert room == "app/halves: 4 of 6 mutants noticed"
    assert total.endswith("4 of 6 mutants noticed")


def test_rooms_have_modules_and_tests():
    rooms = mutations.rooms()
    assert {"app/checking", "app/poses", "renderer", "renderer/scene"} <= rooms.keys()
    assert all(mutations.tests_of(room) for room in rooms)


def test_every_command_says_what_it_does(capsys):
    found = commands()
    assert MINUTES.keys() <= found.keys()
    # Each may be ended late: all together still take half an hour.
    assert 60 * sum(MINUTES.values()) + GRACE_S * len(found) <= 1800
    assert all(told.endswith(".") for told in found.values())
    for name in found:
        tree = ast.parse((ROOT / "tests" / "attack" / f"{name}.py").read_text())
        signature = next(node for node in tree.body if getattr(node, "name", "") == "main")
        assert len(signature.args.args) == 1, name
    assert main(["--help"]) == 0
    assert "random_events" in capsys.readouterr().out
    assert main(["no such attack"]) == 2


@needs_fork
def test_work_in_a_process_of_its_own_has_a_limit():
    assert forks.forked(lambda: {"a": [1, 2]}, 60.0) == {"a": [1, 2]}
    assert forks.forked(lambda: time.sleep(60), 0.3) is None
    assert forks.forked(lambda: 1 / 0, 60.0) is None


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a child goes on to its own end")
def test_what_is_forked_ends_with_whoever_started_it(tmp_path):
    """Also where that is killed, as an attack is that takes too long: nothing goes on behind it."""
    told = tmp_path / "child"
    code = (
        "import os, time\nfrom pathlib import Path\nfrom tests.attack.forks import forked\n"
        f"def work():\n    Path({str(told)!r}).write_text(str(os.getpid()))\n    time.sleep(60)\n"
        "forked(work, 60.0)"
    )
    parent = subprocess.Popen([sys.executable, "-c", code], cwd=ROOT)
    try:
        end_s = time.monotonic() + 30
        while not (told.exists() and told.read_text()) and time.monotonic() < end_s:
            time.sleep(0.01)
    finally:
        parent.kill()
        parent.wait()
    child = Path("/proc", told.read_text(), "stat")
    while time.monotonic() < end_s:
        try:  # "Z" until somebody has asked for its end
            if child.read_text().rpartition(")")[2].split()[0] == "Z":
                return
        except (FileNotFoundError, ProcessLookupError):
            return
        time.sleep(0.01)
    raise AssertionError("it goes on")
