"""The attacks' own machinery. The attacks themselves are no tests: `make attack`."""

from __future__ import annotations

import ast
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.attack import forks, mutations
from tests.attack.__main__ import GRACE_S, MINUTES, commands, main
from tests.attack.mutants import compiled, mutants, outermost

ROOT = Path(__file__).parents[2]
SOURCE = '''\
"""A module."""
LIMIT = 3
TABLE = dict(a=1)


class Thing:
    size: int = 2

    def grown(self, by: float = 1.5) -> float:
        """By so much."""
        if by < 0 or not self.size:
            raise ValueError(f"{by + 1} is wrong")
        return -(self.size + by)


def several(numbers):
    assert numbers != 0
    return [n for n in numbers if n > LIMIT]
'''
WANTED = {
    ("", "1 -> 2"),
    ("", "2 -> 3"),
    ("", "1.5 -> 2.25"),
    ("Thing.grown", "Lt -> LtE"),
    ("Thing.grown", "Lt -> GtE"),
    ("Thing.grown", "0 -> 1"),
    ("Thing.grown", "Or -> And"),
    ("Thing.grown", "condition negated"),
    ("Thing.grown", "statement removed"),
    ("Thing.grown", "returns None"),
    ("Thing.grown", "without minus"),
    ("Thing.grown", "Add -> Sub"),
    ("several", "returns None"),
    ("several", "Gt -> GtE"),
    ("several", "Gt -> LtE"),
    ("several", "filter 0 negated"),
}


def test_every_kind_of_change_is_made_and_types_and_errors_left_alone(tmp_path):
    (tmp_path / "thing.py").write_text(SOURCE)
    found = mutants(tmp_path, "thing.py")
    assert {(mutant.function, mutant.key.split(" | ")[1]) for mutant in found} == WANTED
    assert len({mutant.key for mutant in found}) == len(found)
    assert outermost(tmp_path, "thing.py") == {"Thing.grown": (9, 13), "several": (16, 18)}


def test_tolerances_are_changed_in_the_renderers_alone(tmp_path):
    source = "LIMIT = 1 / 4\n\n\ndef near(size):\n    return size < 8e-6\n"
    told = {}
    for package in ("app", "renderer"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "thing.py").write_text(source)
        for mutant in mutants(tmp_path, f"{package}/thing.py"):
            space: dict = {}
            exec(compiled(tmp_path, mutant), space)
            near = [size for size in (7e-7, 7e-6, 7e-5) if space["near"](size)]
            told[package, mutant.key.split(" | ")[1]] = space["LIMIT"], near
    assert {change for package, change in told if package == "app"} == {
        "Lt -> LtE",
        "Lt -> GtE",
        "returns None",
    }
    assert told["renderer", "ten times"] == (2.5, [7e-7, 7e-6])
    assert told["renderer", "a tenth"] == (0.025, [7e-7, 7e-6])
    assert told["renderer", "ten times 8e-06"] == (0.25, [7e-7, 7e-6, 7e-5])
    assert told["renderer", "a tenth 8e-06"] == (0.25, [7e-7])


def test_a_mutants_code_has_its_change_and_no_other(tmp_path):
    (tmp_path / "thing.py").write_text(SOURCE)
    results = {}
    for mutant in mutants(tmp_path, "thing.py"):
        space: dict = {}
        exec(compiled(tmp_path, mutant), space)
        try:
            grown = space["Thing"]().grown(2.5)
        except ValueError:
            grown = None
        told = mutant.key.split(" | ")[1]
        results[told, mutant.function] = (grown, space["several"]([1, 3, 4]))
    assert results["Add -> Sub", "Thing.grown"] == (0.5, [4])
    assert results["Lt -> GtE", "Thing.grown"] == (None, [4])
    assert results["2 -> 3", ""] == (-5.5, [4])
    assert results["Gt -> GtE", "several"] == (-4.5, [3, 4])
    assert results["filter 0 negated", "several"] == (-4.5, [1, 3])


@pytest.mark.skipif(not hasattr(__import__("os"), "fork"), reason="needs fork")
def test_what_only_a_trace_function_calls_is_tried_with_all_tests(tmp_path):
    """No profile function sees it there."""
    (tmp_path / "traced.py").write_text("def doubled(x):\n    return 2 * x\n")
    (tmp_path / "test_traced.py").write_text(
        "import sys\nimport traced\n"
        "def test_it():\n"
        "    seen = []\n"
        "    before = sys.gettrace()\n"
        "    sys.settrace(lambda *_: seen.append(traced.doubled(0.0)))\n"
        "    (lambda: None)()\n"
        "    sys.settrace(before)\n"
        "    assert seen[0] == 0.0\n"
    )
    chosen = mutants(tmp_path, "traced.py")
    program = (
        "import sys; from pathlib import Path; from tests.attack.mutants import mutants\n"
        "from tests.attack.mutated_run import collected_run\n"
        f"root = Path({str(tmp_path)!r}); tests = [str(root / 'test_traced.py')]\n"
        "found = collected_run(root, 'traced.py', mutants(root, 'traced.py'), tests)\n"
        f"Path({str(tmp_path / 'found')!r}).write_text(repr(found['outcomes']))\n"
    )
    subprocess.run([sys.executable, "-c", program], cwd=ROOT, timeout=120, check=True)
    outcomes = ast.literal_eval((tmp_path / "found").read_text())
    assert {mutant.key.rpartition("| ")[2]: outcomes[mutant.key] for mutant in chosen} == {
        "Mult -> Div": "killed",
        "2 -> 3": "unreached",
        "returns None": "killed",
    }


def test_the_modules_and_their_tests_are_there():
    for module, tests in mutations.MODULES.items():
        assert (ROOT / module).is_file(), module
        for name in tests:
            assert len(list(ROOT.glob(f"tests/**/test_{name}.py"))) == 1, name


def test_known_mutants_are_still_there():
    """One that has gone with its line is to be taken from the list."""
    there = {mutant.key for module in mutations.all_modules() for mutant in mutants(ROOT, module)}
    known = mutations.known_mutants()
    assert [key for key in known if key not in there] == []
    assert all(reason.strip() for reason in known.values())


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


@pytest.mark.skipif(not hasattr(__import__("os"), "fork"), reason="needs fork")
def test_work_in_a_process_of_its_own_has_a_limit():
    import time

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


def test_no_module_is_begun_when_the_time_is_over(capsys):
    assert mutations.main(["--minutes", "0"]) == 0
    assert (
        f"0 of {len(mutations.all_modules())} modules, 0 mutants, 0 survived"
        in capsys.readouterr().out
    )
