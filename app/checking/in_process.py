"""A stand-in for the student's process, until that is there: runs the file in this one."""

from __future__ import annotations

import contextlib
import io
import runpy
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from app.checking.calls import Call, Failure, Run


class InProcess:
    """See app.checking.calls.Student."""

    def __init__(self, path: Path) -> None:
        self._names = runpy.run_path(str(path))

    def functions(self) -> frozenset[str]:
        return frozenset(name for name, value in self._names.items() if callable(value))

    def call(self, calls: Sequence[Call]) -> Run:
        values: list[Any] = []
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            for call in calls:
                arguments = [_object(value) for _, value in call.arguments]
                try:
                    values.append(_json(self._names[call.function](*arguments)))
                except Exception as error:
                    values.append(Failure("exception", f"{type(error).__name__}: {error}"))
        return Run(tuple(values), printed.getvalue())

    def stop(self) -> None: ...

    def close(self) -> None: ...


def _object(value: Any) -> Any:
    if isinstance(value, dict):
        return SimpleNamespace(**{name: _object(part) for name, part in value.items()})
    return tuple(map(_object, value)) if isinstance(value, list) else value


def _json(value: Any) -> Any:
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [_json(part) for part in value]
    if hasattr(value, "origin"):
        return {"origin": _json(value.origin), "direction": _json(value.direction)}
    return value
