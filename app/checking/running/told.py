"""Calls and limits as text for messages."""

from __future__ import annotations

import signal

from lucida.app.checking.calls import Call, Kind, Limits
from lucida.app.checking.kinds.values import text_of
from lucida.app.checking.running.program import ProgramOverError
from lucida.app.ui.explaining.symbols import arguments
from lucida.renderer.system.errors import one_line, shortened

_LONGEST_VALUE = 80


def told_call(call: Call) -> str:
    """Return the call in one line: viewing_ray(i=3, j=4, camera={eye: (0, 0, 5), ...})."""
    given = (
        f"{name}={shortened(arguments(text_of(value), call.notation), _LONGEST_VALUE)}"
        for name, value in ((arguments(n, call.notation), v) for n, v in call.arguments)
    )
    return one_line(f"{call.function}({', '.join(given)})")


def told_over(over: ProgramOverError, limits: Limits, it: str) -> tuple[Kind, str]:
    """Return the kind of failure, and what ended a program. it: "it" or "its process"."""
    if over.why == "time":
        return "time", f"the time limit of {limits.seconds:g} s is over"
    ends = {
        "stopped": "was stopped",
        "length": "answered too much",
        "garbled": "wrote into a file of ours: one that it has not opened itself",
    }
    return "ended", f"{it} {ends.get(over.why) or _told_status(over.status)}"


def _told_status(status: int | None) -> str:
    """Describe how a program ended, from its exit status; -9 means signal 9."""
    if status is None:
        return "closed what it answers through"
    if status >= 0:
        return f"ended with exit status {status}"
    return f"was ended by signal {-status} ({signal.strsignal(-status)})"


def whole_number(text: str) -> int | float:
    """Return an integer of an answer. Integers of 18 or more characters become floats."""
    return int(text) if len(text) < 18 else float(text)
