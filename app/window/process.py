"""The process of a command: its standard streams, and Ctrl-C. This module is light to import."""

from __future__ import annotations

import io
import os
import signal
import sys
import threading


def open_streams() -> None:
    """Connect closed streams (`lucida ... >&-`) to the null device, so that none of our files takes
    their place and no print fails.
    """
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest free number: this one
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        stream = getattr(sys, name)
        if isinstance(stream, io.TextIOWrapper):  # a terminal may lack some characters
            stream.reconfigure(errors="backslashreplace")


def end_by_interrupt(at_once: bool) -> None:
    """Let Ctrl-C end the process at once, without a message, or raise KeyboardInterrupt as usual.

    Nothing changes if Ctrl-C is ignored or handled otherwise.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    now = signal.getsignal(signal.SIGINT)
    if at_once and now is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    elif not at_once and now is signal.SIG_DFL:
        signal.signal(signal.SIGINT, signal.default_int_handler)
