"""Runs tests on a mutant: in a fresh interpreter, or after one collection in a fork for each.

Both functions are for a process of their own, which ends afterwards. Imported early: packages that
no mutant is in, and that take long to load.
"""

from __future__ import annotations

import gc
import importlib
import importlib.abc
import importlib.machinery
import importlib.util
import os
import resource
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import hypothesis
import numba  # noqa: F401
import numpy as np  # noqa: F401
import pytest
from imgui_bundle import imgui  # noqa: F401

from tests.attack.forks import forked
from tests.attack.mutants import Mutant, compiled, outermost

ARGUMENTS = ("-x", "-q", "-p", "no:cacheprovider", "-W", "ignore:Module already imported")
MEMORY_BYTES = 16 << 30
LEAST_S = 5.0


def _prepare() -> int:
    """No output; a bound on memory. Gives what leads to the output that was."""
    told = os.dup(1)
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    return told


class _Examples:
    """The same examples for all mutants, none kept. After conftest.py has said what it wants."""

    count = 100

    def pytest_sessionstart(self) -> None:
        hypothesis.settings.register_profile(
            "mutants",
            max_examples=self.count,
            deadline=None,
            derandomize=True,
            database=None,
            print_blob=False,
            phases=(hypothesis.Phase.explicit, hypothesis.Phase.generate),  # noticed is enough
        )
        hypothesis.settings.load_profile("mutants")


class _Loader(importlib.machinery.SourceFileLoader):
    def __init__(self, name: str, path: str, code: CodeType) -> None:
        super().__init__(name, path)
        self._code = code

    def get_code(self, fullname: str) -> CodeType:
        return self._code


class _Finder(importlib.abc.MetaPathFinder):
    """Gives a module its mutated code when it is imported."""

    def __init__(self, root: Path, mutant: Mutant) -> None:
        self._name = mutant.module.removesuffix(".py").replace("/", ".")
        self._path = str(root / mutant.module)
        self._code = compiled(root, mutant)

    def find_spec(self, fullname: str, path: Any, target: Any = None) -> Any:
        if fullname != self._name:
            return None
        loader = _Loader(fullname, self._path, self._code)
        return importlib.util.spec_from_file_location(fullname, self._path, loader=loader)


def fresh_run(root: Path, mutant: Mutant, tests: list[str]) -> dict[str, bool]:
    """{"passed": whether no test notices the mutant}."""
    _prepare()
    sys.meta_path.insert(0, _Finder(root, mutant))
    status = pytest.main([*ARGUMENTS, f"--rootdir={root}", *tests], plugins=[_Examples()])
    return {"passed": status == 0}


def collected_run(root: Path, module: str, chosen: list[Mutant], tests: list[str]) -> dict:
    """{"outcomes": by key "killed", "survived" or "unreached", but of mutants that run at import;
    "reached", "lengths": of each test the functions that it runs, and its seconds}.

    {"error": ...} where the tests do not pass as they are.
    """
    told = _prepare()
    plugin = _Plugin(root, module, [mutant for mutant in chosen if mutant.function], told)
    status = pytest.main([*ARGUMENTS, f"--rootdir={root}", *tests], plugins=[plugin])
    return plugin.found or {"error": f"pytest ends with {int(status)}"}


class _Plugin(_Examples):
    count = 25  # enough for most mutants; what survives is tried afresh, with all

    def __init__(self, root: Path, module: str, chosen: list[Mutant], told: int) -> None:
        self._root, self._module, self._chosen, self._told = root, module, chosen, told
        self._failed = ""
        self.found: dict[str, Any] = {}

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self._failed = report.nodeid

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        if session.testsfailed:
            return True
        items = session.items
        lengths, reached, failed = self._baseline(items)
        if failed:
            self.found = {"error": failed}
            return True
        # It may be imported only when it is used, which in here is in the forks.
        importlib.import_module(self._module.removesuffix(".py").replace("/", "."))
        loaded = _loaded(self._root / self._module)
        gc.freeze()  # what is not looked through in a fork is not copied for it
        killers: dict[str, int] = {}
        outcomes = {}
        for number, mutant in enumerate(self._chosen, start=1):
            seen = [item for item in items if mutant.function in reached[item.nodeid]]
            wanted = seen or items[:]  # calls from a trace function are not seen
            wanted.sort(key=lambda item: (-killers.get(item.nodeid, 0), lengths[item.nodeid]))
            limit_s = LEAST_S + 4 * sum(lengths[item.nodeid] for item in wanted)
            killer = forked(lambda m=mutant, w=wanted: self._try(m, w, loaded), limit_s)  # type: ignore[misc]
            outcomes[mutant.key] = "killed"
            if killer == "":
                outcomes[mutant.key] = "survived" if seen else "unreached"
                told = f"{len(seen)} tests pass" if seen else "no test is seen to run it"
                self._tell(number, mutant, told)
            if killer:
                killers[killer] = killers.get(killer, 0) + 1
        self.found = {"outcomes": outcomes, "reached": reached, "lengths": lengths}
        return True

    def _tell(self, number: int, mutant: Mutant, why: str) -> None:
        """Of one that is not noticed yet, at once: a module can take an hour."""
        line = f"  ({number} of {len(self._chosen)}: {why}) line {mutant.line}: {mutant.key}\n"
        os.write(self._told, line.encode())

    def _baseline(self, items: list[pytest.Item]) -> tuple[dict, dict, str]:
        """Of each test its time in seconds and the module's functions that it reaches; and one
        that fails. In a fork, so that what it leaves behind is in no mutant's way."""
        spans = outermost(self._root, self._module)
        path = str(self._root / self._module)

        def work() -> Any:
            calls: set[int] = set()

            def look(frame: Any, event: str, _: Any) -> None:
                if event == "call" and frame.f_code.co_filename == path:
                    calls.add(frame.f_code.co_firstlineno)

            lengths, reached = {}, {}
            for item, after in _in_order(items):
                calls.clear()
                began_s = time.perf_counter()
                threading.setprofile(look)
                sys.setprofile(look)
                _run(item, after)
                sys.setprofile(None)
                if self._failed:
                    return {}, {}, self._failed
                lengths[item.nodeid] = time.perf_counter() - began_s
                reached[item.nodeid] = [
                    name
                    for name, (first, last) in spans.items()
                    if any(first <= line <= last for line in calls)
                ]
            return lengths, reached, ""

        answer = forked(work, 3600.0)
        return tuple(answer) if answer else ({}, {}, "the tests end without a result")

    def _try(self, mutant: Mutant, items: list[pytest.Item], loaded: list[FunctionType]) -> str:
        """The first test that notices; empty: none."""
        if not _replace(self._root, mutant, loaded):
            return ""
        for item, after in _in_order(items):
            _run(item, after)
            if self._failed:
                return self._failed
        return ""


def _in_order(items: list[pytest.Item]) -> Iterator[tuple[pytest.Item, pytest.Item | None]]:
    """Each with the next, for which fixtures are kept."""
    return zip(items, [*items[1:], None], strict=True)


def _run(item: pytest.Item, after: pytest.Item | None) -> None:
    item.config.hook.pytest_runtest_protocol(item=item, nextitem=after)


def _loaded(path: Path) -> list[FunctionType]:
    """The functions of a module."""
    return [
        function
        for function in gc.get_objects()
        if isinstance(function, FunctionType) and function.__code__.co_filename == str(path)
    ]


def _replace(root: Path, mutant: Mutant, loaded: list[FunctionType]) -> bool:
    """Puts the mutant's code into the loaded function; whether it was found."""
    code = compiled(root, mutant)
    for name in mutant.function.split("."):
        parts = (part for part in code.co_consts if isinstance(part, CodeType))
        code = next(part for part in parts if part.co_name == name)
    found = False
    for function in loaded:
        if (
            function.__code__.co_qualname == mutant.function
            and function.__code__.co_firstlineno == code.co_firstlineno
        ):
            function.__code__ = code
            found = True
    return found
