"""A process that begins quickly: what its start does in vain is left out.

Half a second goes by before a window has its first picture, and it is Python's: hundreds of files
are imported. Owns what is set before that, for the whole process:

- What is imported stays: garbage is looked for after 20,000 new objects, not after each 700, and
  not at all while the window's modules are imported.
- The methods of dataclasses are made of text, which is compiled: six of them a class, most of which
  are never called. Here each is compiled at its first call.
- NumPy's matrix library has one thread. It takes longer to wake others than to multiply the small
  matrices of this program, and they go on waiting at work, on a processor that others need.
"""

from __future__ import annotations

import atexit
import contextlib
import dataclasses
import gc
import inspect
import os
import sys
import threading
from collections.abc import Callable, Iterator
from typing import Any, NoReturn

YOUNG_OBJECTS = 20_000  # between two collections of the youngest, a millisecond each

Create = Callable[..., Any]
_PARAMETERS = ["name", "args", "body", "globals", "locals", "return_type"]


def begin() -> None:
    """Before anything else is imported."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    _, middle, old = gc.get_threshold()
    gc.set_threshold(YOUNG_OBJECTS, middle, old)
    create: Create | None = getattr(dataclasses, "_create_fn", None)
    # Later versions of Python make all methods of a class of one text, in a third of the time.
    if create is not None and list(inspect.signature(create).parameters) == _PARAMETERS:
        setattr(dataclasses, "_create_fn", lazily(create))  # noqa: B010 - not in its types


@contextlib.contextmanager
def without_garbage() -> Iterator[None]:
    """While much is imported, and nothing let go; nor is any of it looked through later."""
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


def end(status: int) -> NoReturn:
    """Ends the process as sys.exit() would, with all that others have asked to be done then; but
    the memory of a thousand modules goes back as a whole, not object by object."""
    for thread in threading.enumerate():
        if thread is not threading.main_thread() and not thread.daemon:
            thread.join()
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):  # closed, or none at all
            stream.flush()
    os._exit(status)


def lazily(create: Create) -> Create:
    """The function that makes a dataclass' method, as one whose methods are made when they are
    first called, and take their own place in the class then."""

    def create_later(name: str, *arguments: Any, **options: Any) -> Any:
        made: Any = None

        def method(self: Any, /, *given: Any, **named: Any) -> Any:
            nonlocal made
            if made is None:
                made = create(name, *arguments, **options)
                made.__qualname__ = method.__qualname__
            for owner in type(self).__mro__:
                if owner.__dict__.get(name) is method:
                    setattr(owner, name, made)
            return made(self, *given, **named)

        method.__name__ = name
        return method

    return create_later
