"""Change single lines of the code that draws nothing, and report which changes no test notices.

    python -m tools.attack mutations --room app/instruments/poses --sample 50 --seed 3

A room is a folder of the source, and its tests are those of the folder of the same name. A process
collects a room's tests once, sees which functions each of them calls, and forks for each mutant,
which puts the changed code into the loaded functions; there the tests run that reach them. Some
mutants change nothing that anybody could see (the sign of a number that is only compared with
itself), so what counts is the share that is noticed. Needs fork.
"""

from __future__ import annotations

import argparse
import functools
import gc
import importlib
import math
import os
import random
import resource
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import hypothesis
import pytest

from tools.attack.forks import forked
from tools.attack.mutants import Mutant, compiled, mutants, spans

ROOT = Path(__file__).parents[2]
# A room's tests lie in the folder of its name. Others that are about it:
TESTS = {
    "app/images": ("renderer/images",),
    "renderer/camera": ("app/cameras",),
    "renderer/compare": ("parity",),
    "renderer/files": ("renderer/editing",),
    "renderer/images": ("renderer/files", "app/images"),
    "renderer/scene": ("renderer/files", "renderer/editing"),
}
NO_MUTANTS = ("imgui_bundle", "moderngl", "numba")  # a window, a driver, machine code
# Tests of windows and of installations: they take minutes.
SLOW = ("/window/", "/test_wheel", "/test_isolation")
NOTICED, TRIED = 0.8, 20  # the share that must be noticed, once so many were tried
CACHE = type(functools.cache(len))
FORGOTTEN = ("tests", "lucida/app", "lucida/renderer/camera")  # whose caches are emptied
ARGUMENTS = ("-x", "-q", "-p", "no:cacheprovider", "-W", "ignore:Module already imported")
MEMORY_BYTES = 16 << 30
BASELINE_S, LEAST_S, LONGEST_S = 600.0, 5.0, 10.0  # limits; tests that take longer are left out


def rooms() -> dict[str, list[str]]:
    """Return the modules of each room that has tests and code that draws nothing."""
    found: dict[str, list[str]] = {}
    for path in sorted([*ROOT.glob("app/*/**/*.py"), *ROOT.glob("renderer/*/**/*.py")]):
        name, text = path.relative_to(ROOT).as_posix(), path.read_text("utf-8")
        parts = path.relative_to(ROOT).parts
        room = "/".join(parts[: 3 if parts[1] == "instruments" else 2])
        if tests_of(room) and not any(word in text for word in NO_MUTANTS):
            found.setdefault(room, []).append(f"lucida/{name}")  # as it is imported
    return found


def tests_of(room: str) -> list[str]:
    """Return the paths of a room's test files."""
    folders = (room, *TESTS.get(room, ()))
    paths = (path for folder in folders for path in ROOT.glob(f"tests/{folder}/**/test_*.py"))
    return sorted(str(p) for p in paths if not any(slow in p.as_posix() for slow in SLOW))


def main(argv: Sequence[str]) -> int:
    """Return 1 where too few mutants are noticed, or a room's tests do not pass as they are."""
    parser = argparse.ArgumentParser("mutations", description=(__doc__ or "").split("\n")[0])
    there = rooms()
    parser.add_argument("--room", action="append", choices=sorted(there), help="may be repeated")
    parser.add_argument("--module", default="", help="only modules whose path contains this")
    parser.add_argument("--sample", type=int, default=40, help="of each room; 0: all")
    parser.add_argument("--seed", type=int, help="a random one where none is given")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin nothing after that")
    arguments = parser.parse_args(argv)
    if not hasattr(os, "fork"):
        print("mutations: this system cannot fork")
        return 0
    seed = random.randrange(1 << 20) if arguments.seed is None else arguments.seed
    rng = random.Random(seed)
    end_s = time.monotonic() + 60 * arguments.minutes
    chosen_rooms = arguments.room or rng.sample(sorted(there), len(there))
    tried = noticed = broken = 0
    for room in chosen_rooms:
        modules = [module for module in there[room] if arguments.module in module]
        chosen = [mutant for module in modules for mutant in mutants(ROOT, module)]
        if 0 < arguments.sample < len(chosen):
            chosen = rng.sample(chosen, arguments.sample)
        left_s = end_s - time.monotonic()
        if left_s <= 0:
            break
        limit_s = min(left_s + 60, 36000)
        found = forked(lambda r=room, c=chosen: try_all(r, c, end_s), limit_s)  # type: ignore[misc]
        if found is None and limit_s < BASELINE_S:
            print(f"{room}: the time was over before its tests had run once", flush=True)
            continue
        if found is None or "error" in found:
            print(f"{room}: no mutant was tried: {found and found['error']}", flush=True)
            broken += 1
            continue
        killed = sum(found["noticed"])
        tried, noticed = tried + len(found["noticed"]), noticed + killed
        print(f"{room}: {killed} of {len(found['noticed'])} mutants noticed", flush=True)
    print(f"mutations: seed {seed}, {noticed} of {tried} mutants noticed", flush=True)
    return int(broken > 0 or (tried >= TRIED and noticed < NOTICED * tried))


def try_all(room: str, chosen: list[Mutant], end_s: float) -> dict[str, Any]:
    """Run a room's tests on each mutant, for a process of its own, which ends afterwards.

    Return {"noticed": a boolean for each that was tried before end_s}, or {"error": why} where the
    tests do not pass as they are.
    """
    out = os.dup(1)
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    limits = MEMORY_BYTES, MEMORY_BYTES
    resource.setrlimit(resource.RLIMIT_DATA, limits)  # not AS: a browser reserves more addresses
    plugin = _Plugin(chosen, out, end_s)
    status = pytest.main([*ARGUMENTS, f"--rootdir={ROOT}", *tests_of(room)], plugins=[plugin])
    return plugin.found or {"error": f"pytest ends with {int(status)}"}


class _Plugin:
    """Takes the place of pytest's loop over the tests."""

    def __init__(self, chosen: list[Mutant], out: int, end_s: float) -> None:
        self._chosen, self._out, self._end_s = chosen, out, end_s
        self._failed = ""
        self.found: dict[str, Any] = {}

    def pytest_sessionstart(self) -> None:
        """Take the same few examples for all mutants, and keep none."""
        hypothesis.settings.register_profile(
            "mutants",
            max_examples=25,
            deadline=None,
            derandomize=True,
            database=None,
            phases=(hypothesis.Phase.explicit, hypothesis.Phase.generate),  # noticed is enough
        )
        hypothesis.settings.load_profile("mutants")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self._failed = report.nodeid

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        if session.testsfailed:
            return True
        items = session.items
        # A module may be imported only when it is used, which here is in the forks.
        for module in {mutant.module for mutant in self._chosen}:
            importlib.import_module(module.removesuffix(".py").replace("/", "."))
        gc.unfreeze()  # the tests' imports end with a freeze: nothing would be found
        objects = gc.get_objects()
        functions = [one for one in objects if isinstance(one, FunctionType)]
        caches = [one for one in objects if _is_cache_of_ours(one)]
        del objects
        gc.freeze()  # what is not looked through in a fork is not copied for it
        _forget(caches)  # what the tests' imports computed comes from no mutant
        answer = forked(lambda: self._baseline(items, caches), BASELINE_S)
        if answer is None or self._failed or answer["failed"]:
            self.found = {"error": (answer or {}).get("failed") or "no result"}
            return True
        lengths, reached = answer["lengths"], answer["reached"]
        if planted := self._missed(items, reached, functions):
            self.found = {"error": f"no test notices that {planted} fails: the attack sees nothing"}
            return True
        killers: dict[str, int] = {}
        noticed = []
        for mutant in self._chosen:
            if time.monotonic() >= self._end_s:
                break
            name = f"{mutant.module} {mutant.function}"
            seen = _reaching(name, items, reached)
            seen.sort(key=lambda item: (-killers.get(item.nodeid, 0), lengths[item.nodeid]))
            limit_s = LEAST_S + 4 * sum(lengths[item.nodeid] for item in seen)
            killer = forked(lambda m=mutant, s=seen: self._try(m, s, functions), limit_s)  # type: ignore[misc]
            noticed.append(killer != "")
            if killer == "":
                why = f"{len(seen)} tests pass" if seen else "no test runs it"
                os.write(self._out, f"  {mutant.text} ({why})\n".encode())
            elif killer:
                killers[killer] = killers.get(killer, 0) + 1
        self.found = {"noticed": noticed}
        return True

    def _missed(
        self,
        items: list[pytest.Item],
        reached: dict[str, list[str]],
        functions: list[FunctionType],
    ) -> str:
        """Plant a fault that the tests must find: the function that most of them call fails.

        Return the function's name where none of them notices it.
        """
        counts = Counter(name for names in reached.values() for name in names)
        if not counts:
            return ""
        ((name, _),) = counts.most_common(1)
        seen = _reaching(name, items, reached)

        def plant() -> str:
            for function in _called(*name.split(" "), functions):
                freevars = function.__code__.co_freevars
                function.__code__ = _failing.__code__.replace(co_freevars=freevars)
            return self._run_until_failure(seen)

        return name if forked(plant, BASELINE_S) == "" else ""

    def _baseline(self, items: list[pytest.Item], caches: list[Any]) -> dict[str, Any]:
        """Return of each test its seconds and the functions that it calls; and one that fails.

        Each test begins with empty caches: it calls a function, too, whose result an earlier one
        has left there.
        """
        names: dict[tuple[str, int], str] = {}
        for module in {mutant.module for mutant in self._chosen}:
            for name, lines in spans(ROOT, module).items():
                names |= {(str(ROOT / module), line): f"{module} {name}" for line in lines}
        calls: set[str] = set()

        def look(frame: Any, event: str, _: Any) -> None:
            code = frame.f_code
            if event == "call" and (name := names.get((code.co_filename, code.co_firstlineno))):
                calls.add(name)

        lengths, reached = {}, {}
        for item, after in _in_order(items):
            calls.clear()
            _forget(caches)
            began_s = time.perf_counter()
            threading.setprofile(look)
            sys.setprofile(look)
            _run(item, after)
            sys.setprofile(None)
            lengths[item.nodeid] = time.perf_counter() - began_s
            reached[item.nodeid] = sorted(calls) if lengths[item.nodeid] < LONGEST_S else []
            if self._failed:
                break
        return {"lengths": lengths, "reached": reached, "failed": self._failed}

    def _try(self, mutant: Mutant, items: list[pytest.Item], functions: list[FunctionType]) -> str:
        """Return the first test that notices a mutant; empty if none does."""
        _replace(mutant, functions)
        return self._run_until_failure(items)

    def _run_until_failure(self, items: list[pytest.Item]) -> str:
        for item, after in _in_order(items):
            _run(item, after)
            if self._failed:
                return self._failed
        return ""


def _is_cache_of_ours(one: Any) -> bool:
    """Return True for a functools.cache of the tests or the code; not of kernels and contexts."""
    if not isinstance(one, CACHE):
        return False
    path = one.__wrapped__.__code__.co_filename if isinstance(one.__wrapped__, FunctionType) else ""
    return path.startswith(tuple(f"{ROOT}/{folder}/" for folder in FORGOTTEN))


def _forget(caches: list[Any]) -> None:
    for one in caches:
        one.cache_clear()


def _failing(*_: Any, **__: Any) -> None:
    raise AssertionError("a planted fault")


def _in_order(items: list[pytest.Item]) -> Iterator[tuple[pytest.Item, pytest.Item | None]]:
    """Pair each test with the next, for which fixtures are kept."""
    return zip(items, [*items[1:], None], strict=True)


def _run(item: pytest.Item, after: pytest.Item | None) -> None:
    item.config.hook.pytest_runtest_protocol(item=item, nextitem=after)


def _replace(mutant: Mutant, functions: list[FunctionType]) -> None:
    """Put a mutant's code into those functions that have its name and place."""
    code = compiled(ROOT, mutant)
    for name in mutant.function.split("."):
        parts = (part for part in code.co_consts if isinstance(part, CodeType))
        code = next(part for part in parts if part.co_name == name)
    for function in _called(mutant.module, mutant.function, functions):
        if function.__code__.co_firstlineno == code.co_firstlineno:
            function.__code__ = code


def _called(module: str, name: str, functions: list[FunctionType]) -> list[FunctionType]:
    """Return the loaded functions of a module that have a qualified name."""
    place = str(ROOT / module), name
    codes = ((function, function.__code__) for function in functions)
    return [function for function, c in codes if (c.co_filename, c.co_qualname) == place]


def _reaching(
    name: str, items: list[pytest.Item], reached: dict[str, list[str]]
) -> list[pytest.Item]:
    """Return the tests that call a function."""
    return [item for item in items if name in reached.get(item.nodeid, ())]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
