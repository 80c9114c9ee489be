"""A film that is made while the window goes on: in a process of its own, with progress and cancel.

The frames that are there stay if it ends early: another film of the same name goes on with them.
"""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import tempfile
import time

from app.films.order import Order
from app.widgets.background import Background
from renderer.child import end_child, interpreter, start_child
from renderer.errors import LucidaError, describe, one_line

CHILD = "app.films.child"


class Making:
    """part: the finished part, 0 to 1. first: what was finished before. name: of the file."""

    def __init__(self) -> None:
        self._work: Background[str] = Background("lucida-film")
        self._process: subprocess.Popen[bytes] | None = None
        self._began_s = 0.0
        self._cancelled = False
        self.part = self.first = 0.0
        self.name = ""

    @property
    def busy(self) -> bool:
        return self._work.busy

    @property
    def time_s(self) -> float:
        """Return for how long it has been drawn."""
        return time.monotonic() - self._began_s

    def begin(self, order: Order) -> None:
        """Start a film. Raises LucidaError if the file cannot hold it. Call while none is made."""
        order.check()
        self._cancelled, self.part, self.first = False, 0.0, 0.0
        self.name, self._began_s = one_line(order.path.name), time.monotonic()
        self._work.submit(lambda: self._make(order))

    def cancel(self) -> None:
        self._cancelled = True
        if self._process is not None:
            self._process.kill()

    def poll(self) -> tuple[str, bool] | None:
        """Return the message since the last call, and whether it is good news."""
        outcome = self._work.poll()
        if outcome is None:
            return None
        if outcome.error is not None:
            return describe(outcome.error), False
        return outcome.value or "", True

    def close(self) -> None:
        self.cancel()
        self._work.close()

    def _make(self, order: Order) -> str:
        python = interpreter()
        if python is None:
            raise LucidaError("film", "needs a Python of its own", "use `lucida animate`")
        file, name = tempfile.mkstemp(".film")
        with os.fdopen(file, "wb") as content:
            pickle.dump(order, content)
        self._process = process = start_child(python, CHILD, name, output=True)
        if self._cancelled:
            process.kill()
        assert process.stdout is not None
        error, is_begun = "", False
        for line in process.stdout:
            report = json.loads(line)
            error = report.get("error", "")
            self.part = report.get("part", self.part)
            if not is_begun:
                self.first, self._began_s, is_begun = self.part, time.monotonic(), True
            Background.wake_window()
        status = process.wait()
        end_child(process)
        if self._cancelled:
            rest = f"{100 * self.part:.0f} % are there: save it under the same name to go on."
            return f"{self.name} was cancelled. {rest}"
        if error or status:
            raise LucidaError("", error or f"the process ended ({status})", source=self.name)
        return one_line(f"Saved the film as {order.path}.")
