"""Each format's check in a process of its own: programs' libraries clash, and may crash.

Owns how a check is started, and what becomes of one that ends otherwise than it should.
"""

from __future__ import annotations

import multiprocessing
import tempfile
import traceback
import zlib
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib import import_module
from pathlib import Path

from tools.conformance.measured import Checked, Job, PeerMissing
from tools.conformance.report import Outcome
from tools.peer_environment import folder_of


def outcomes(names: Iterable[str], cameras: int) -> Iterator[Outcome]:
    """One after the other. Nothing is raised for a format."""
    spawn = multiprocessing.get_context("spawn")
    for name in names:
        with ProcessPoolExecutor(1, mp_context=spawn) as process:
            try:
                yield process.submit(outcome, name, cameras).result()
            except BrokenProcessPool:
                yield Outcome(name, None, "its process crashed", True)


def outcome(name: str, cameras: int) -> Outcome:
    """In this process. What is random depends on the format alone: the same on every day."""
    with tempfile.TemporaryDirectory() as folder:
        seed = zlib.crc32(name.encode())
        job = Job(cameras, seed, Path(folder), folder_of("conformance"))
        try:
            checked: Checked = import_module(f"tools.conformance.formats.{name}").check(job)
            return Outcome(name, checked)
        except PeerMissing as missing:
            return Outcome(name, None, str(missing))
        except Exception as error:
            traceback.print_exc()
            return Outcome(name, None, f"{type(error).__name__}: {error}".split("\n")[0], True)
