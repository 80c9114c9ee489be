"""Handle failing views: each shows its error and a button to retry; the others keep running."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable

import moderngl
from imgui_bundle import imgui

from lucida.app.images.textures import FAILURES

from .host import Host
from .instrument import Instrument
from .messages import failure_note


class FailedViews:
    """The views that failed, until the user retries. errors: the errors by the views' names."""

    def __init__(self) -> None:
        self.errors: dict[str, Exception] = {}
        self._to_begin: dict[str, Callable[[], None]] = {}  # of views that could not begin

    def begin(self, view: Instrument, host: Host, context: moderngl.Context) -> None:
        """Prepare a view, which fails if a driver rejects its shader, for instance. Call once for
        each, when there is a context.
        """
        try:
            view.begin(host, context)
        except FAILURES as error:
            self.errors[view.name] = error
            self._to_begin[view.name] = lambda: self.begin(view, host, context)

    def _retry(self, name: str) -> None:
        del self.errors[name]
        if begin := self._to_begin.pop(name, None):
            begin()

    def draw(self, view: Instrument, host: Host) -> None:
        """Draw a view's content, or its error."""
        failure = self.errors.get(view.name)
        if failure is not None:
            if failure_note(view.title, failure):
                self._retry(view.name)
            return
        stacks = imgui.internal.ErrorRecoveryState()
        imgui.internal.error_recovery_store_state(stacks)
        try:
            view.draw(host)
        except Exception as error:  # the other views must keep running
            if not isinstance(error, FAILURES):  # our own bug: include the traceback
                traceback.print_exception(error, file=sys.stderr)
            self.errors[view.name] = error
            _unwind(stacks)


def _unwind(stacks: imgui.internal.ErrorRecoveryState) -> None:
    """Close what a failed view left open in ImGui, without reporting that as an error."""
    io = imgui.get_io()
    reports = [f"config_error_recovery_enable_{one}" for one in ("assert", "debug_log", "tooltip")]
    before = {report: getattr(io, report) for report in reports}
    for report in reports:
        setattr(io, report, False)
    imgui.internal.error_recovery_try_to_recover_state(stacks)
    for report, is_on in before.items():
        setattr(io, report, is_on)
