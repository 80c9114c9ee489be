"""Calls and limits as text for messages."""

from __future__ import annotations

import signal
from collections.abc import Iterable
from typing import Any

from app.checking.calls import Call, Kind, Limits
from app.checking.running.program import ProgramOverError
from renderer.errors import one_line, shortened

_LONGEST_CALL = 240
_LONGEST_VALUE = 80


def told_call(call: Call) -> str:
    """Return the call in one line: viewing_ray(i=3, j=4, camera={eye: (0, 0, 5), ...})."""
    given = [f"{name}={told_value(value)}" for name, value in call.arguments]
    return one_line(f"{call.function}({_joined(given, _LONGEST_CALL)})")


def told_value(value: Any) -> str:
    """Return a JSON value as Python writes it, shortened."""
    if isinstance(value, dict):
        parts = (f"{key}: {told_value(part)}" for key, part in value.items())
        return "{" + _joined(parts, _LONGEST_VALUE) + "}"
    if isinstance(value, list | tuple):
        return "(" + _joined(map(told_value, value), _LONGEST_VALUE) + ")"
    return f"{value:.6g}" if isinstance(value, float) else shortened(repr(value), _LONGEST_VALUE)


def _joined(parts: Iterable[str], most: int) -> str:
    """Join as many parts as fit, but at least one."""
    text = ""
    for part in parts:
        if text and len(text) + len(part) > most:
            return text + ", ..."
        text += (", " if text else "") + part
    return text


def told_over(over: ProgramOverError, limits: Limits, it: str) -> tuple[Kind, str]:
    """Return the kind of failure, and what ended a program. it: "it" or "its process"."""
    if over.why == "time":
        return "time", f"the time limit of {limits.seconds:g} s is over"
    ends = {"stopped": "was stopped", "length": "answered too much"}
    return "ended", f"{it} {ends.get(over.why) or _told_status(over.status)}"


def _told_status(status: int | None) -> str:
    """Describe how a program ended, from its exit status; -9 means signal 9."""
    if status is None:
        return "closed what it answers through"
    if status >= 0:
        return f"ended with exit status {status}"
    try:
        return f"was ended by {signal.Signals(-status).name}"
    except ValueError:
        return f"was ended by signal {-status}"


def whole_number(text: str) -> int | float:
    """Return an integer of an answer. Integers of 18 or more characters become floats."""
    return int(text) if len(text) < 18 else float(text)
