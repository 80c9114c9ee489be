"""The process that a command runs in: its standard streams, and Ctrl-C.

Knows nothing of commands. Light to import.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import threading
from types import FrameType

RETRY_S = 0.02
_IMPORTING = "<frozen importlib._bootstrap>"

_waiting: threading.Timer | None = None  # of a Ctrl-C that came during an import


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
        if isinstance(stream, io.TextIOWrapper):  # a terminal need not have every sign
            stream.reconfigure(errors="backslashreplace")


def interrupt_between_imports() -> None:
    """Ctrl-C waits for an import in progress: extension modules take a KeyboardInterrupt for a
    broken installation, or crash. Changes nothing where Ctrl-C is ignored or handled otherwise."""
    is_main = threading.current_thread() is threading.main_thread()
    if is_main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupt)


def interrupt_at_once() -> None:
    """Let Ctrl-C end the process from now on, if that was its effect.

    A KeyboardInterrupt would be reported while Python ends. Raises KeyboardInterrupt as
    interrupt_after_imports does.
    """
    interrupt_after_imports()
    if signal.getsignal(signal.SIGINT) is _interrupt:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def interrupt_after_imports() -> None:
    """Raise KeyboardInterrupt if Ctrl-C came during an import and still waits."""
    global _waiting
    if _waiting is not None:
        _waiting.cancel()
        _waiting.join()  # it may have begun: then KeyboardInterrupt comes here, and not again later
        _waiting = None
        raise KeyboardInterrupt


def _interrupt(number: int, frame: FrameType | None) -> None:
    global _waiting
    if not _is_importing(frame):
        _waiting = None
        raise KeyboardInterrupt
    _waiting = threading.Timer(RETRY_S, _raise_in_main, (number,))
    _waiting.daemon = True
    _waiting.start()


def _raise_in_main(number: int) -> None:
    main = threading.main_thread().ident
    if main is not None and hasattr(signal, "pthread_kill"):
        signal.pthread_kill(main, number)  # so that it also wakes from a wait
    else:
        signal.raise_signal(number)


def _is_importing(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_code.co_filename == _IMPORTING:
            return True
        frame = frame.f_back
    return False
