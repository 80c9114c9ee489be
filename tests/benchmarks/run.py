"""One run of the benchmarks: what was asked for, and who takes part.

Owns the peers that are there and the meshes in use. Knows nothing of what is measured.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path

import numpy as np

from renderer.camera import Size
from tests.benchmarks.lucida import Lucida
from tests.benchmarks.measure import QUICK, Plan, Timing, interleaved
from tests.benchmarks.peers import PEERS, Hits, Peer
from tests.benchmarks.scenes import SUBJECTS, Subject, bumpy_sphere, model

HD, FULL_HD = (1280, 720), (1920, 1080)

# The Debian and Ubuntu packages of the system's libraries that peers load.
SYSTEM_PACKAGES = {
    "usb-1.0": "libusb-1.0-0",
    "llvm": "libllvm15 (or any newer one)",
    "gomp": "libgomp1",
    "gl": "libgl1",
    "egl": "libegl1",
    "x11": "libx11-6",
}


@dataclass
class Run:
    """quick: fewer and smaller cases. full: more rays where rays are counted. file: a model that
    takes the place of the meshes from formulas. left_out: why, for each peer that is not here."""

    quick: bool = False
    full: bool = False
    file: Path | None = None
    kinds: tuple[type[Peer], ...] = ()
    left_out: dict[str, str] = field(default_factory=dict)
    _subjects: dict[str, Subject] = field(default_factory=dict)

    @property
    def plan(self) -> Plan:
        return QUICK if self.quick else Plan()

    @property
    def sizes(self) -> tuple[Size, ...]:
        return (HD,) if self.quick else (HD, FULL_HD)

    def find_peers(self) -> None:
        """Takes in the peers that work here."""
        found = []
        for kind in PEERS:
            try:
                kind().prepare(*bumpy_sphere(100))
                found.append(kind)
            except Exception as error:  # whatever a broken installation raises
                self.left_out[kind.name] = reason(error)
        self.kinds = tuple(found)

    def subject(self, name: str) -> Subject:
        """The mesh of that name, made once."""
        if name not in self._subjects:
            made = model(self.file) if self.file is not None else SUBJECTS[name]()
            self._subjects[name] = made
        return self._subjects[name]

    def subjects(self, *names: str) -> list[Subject]:
        """The meshes of these names; only the model, where one was given; quick: none above 1M."""
        if self.file is not None:
            return [self.subject("model")]
        large = ("1M", "ball 1M", "4M") if self.quick else ()
        return [self.subject(name) for name in names if name not in large]

    def all_kinds(self, *without: type[Peer]) -> tuple[type[Peer], ...]:
        """Lucida first, then the peers, but those that a table leaves out."""
        kinds: tuple[type[Peer], ...] = (Lucida, *self.kinds)
        return tuple(kind for kind in kinds if kind not in without)

    @contextmanager
    def tracers(self, subject: Subject, *without: type[Peer]) -> Iterator[list[Peer]]:
        """Lucida and the peers, ready to trace; closed at the end."""
        ready: list[Peer] = []
        try:
            for kind in self.all_kinds(*without):
                ready.append(kind())
                ready[-1].prepare(subject.vertices, subject.faces)
            yield ready
        finally:
            for tracer in ready:
                tracer.close()

    def time(self, calls: Mapping[str, Callable[[], object]]) -> dict[str, Timing]:
        return interleaved(calls, self.plan)

    def say(self, text: str) -> None:
        """One line on standard error: what is being measured."""
        print(f"bench: {text}", file=sys.stderr, flush=True)


def reason(error: BaseException) -> str:
    """Why a peer does not work, in one line, with the system's package that is missing."""
    text = " ".join(str(error).split()) or type(error).__name__
    library = re.search(r"lib([\w.+-]+?)\.(?:so|dll|dylib)", text)
    key = library[1].lower() if library else "llvm" if "llvm" in text.lower() else ""
    for start, package in SYSTEM_PACKAGES.items():
        if key.startswith(start):
            return f"{text}; install the system's {package}"
    return text


def versions(kinds: tuple[type[Peer], ...]) -> dict[str, str]:
    """The packages' versions, for the peers."""
    return {kind.name: metadata.version(kind.package) for kind in kinds}


def share_that_differs(ours: Hits, theirs: Hits) -> float:
    """The part of the rays for which another primitive was found."""
    return float(np.mean(ours.primitive != theirs.primitive))


def size_text(size: Size) -> str:
    return f"{size[0]}x{size[1]}"
