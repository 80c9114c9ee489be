"""Programs that some tests need, and that `scripts/setup.sh tests` installs."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
from collections.abc import Iterator
from typing import NoReturn

import pytest


def absent(reason: str) -> NoReturn:
    """Skip the test; where CI is set, where nothing may be absent, fail it."""
    (pytest.fail if os.environ.get("CI") else pytest.skip)(reason)


def need(*names: str) -> str:
    """Return the path of the first of these programs that is installed."""
    found = filter(None, map(shutil.which, names))
    return next(found, "") or absent(f"{names[0]} is not installed")


@contextlib.contextmanager
def x_server(size: tuple[int, int]) -> Iterator[str]:
    """Start a display that nobody looks at; yield its name. size: (width, height), in pixels."""
    read, write = os.pipe()
    screen = f"{size[0]}x{size[1]}x24"
    server = subprocess.Popen(
        [need("Xvfb"), "-displayfd", str(write), "-screen", "0", screen],
        pass_fds=(write,),
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    try:
        with os.fdopen(read) as pipe:
            number = pipe.readline().strip()
        assert number, "Xvfb did not start"
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()
