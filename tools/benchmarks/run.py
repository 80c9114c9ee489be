"""One run of the benchmarks: what was asked for, and who takes part.

Owns the tracers' processes and the meshes in use. Knows nothing of what is measured.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lucida.renderer.camera.image_plane import Size
from tools.benchmarks.cameras import look
from tools.benchmarks.embree import NativeEmbree
from tools.benchmarks.lucida import Lucida
from tools.benchmarks.measure import QUICK, Plan, Stopwatch, Timing, interleaved, seconds
from tools.benchmarks.meshes import bumpy_sphere
from tools.benchmarks.peers import Hits, Mitsuba, Open3D, Peer
from tools.benchmarks.processes import TracerProcess
from tools.benchmarks.scenes import SUBJECTS, Subject, model

HD, FULL_HD = (1280, 720), (1920, 1080)
PEERS: tuple[type[Peer], ...] = (Mitsuba, NativeEmbree, Open3D)
RESTLESS = 0.05  # of a processor, while nothing is asked

# The Debian and Ubuntu packages of the system's libraries that peers load.
SYSTEM_PACKAGES = {
    "usb-1.0": "libusb-1.0-0",
    "embree": "libembree-dev",
    "llvm": "libllvm15 (or any newer one)",
    "gomp": "libgomp1",
    "gl": "libgl1",
    "egl": "libegl1",
    "x11": "libx11-6",
}


@dataclass
class Run:
    """quick: fewer and smaller cases. file: a model that
    takes the place of the meshes from formulas. versions: of the peers that are here. left_out:
    why, for each peer that is not."""

    quick: bool = False
    file: Path | None = None
    kinds: tuple[type[Peer], ...] = ()
    versions: dict[str, str] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    _processes: dict[type[Peer], TracerProcess] = field(default_factory=dict)
    _subjects: dict[str, Subject] = field(default_factory=dict)

    @property
    def plan(self) -> Plan:
        return QUICK if self.quick else Plan()

    @property
    def sizes(self) -> tuple[Size, ...]:
        return (HD,) if self.quick else (HD, FULL_HD)

    def find_peers(self) -> None:
        """Takes in the peers that work here and take no processor from the others."""
        found = []
        subject = Subject("sphere", *bumpy_sphere(100))
        processes = {kind: self.process(kind) for kind in PEERS}  # they start at the same time
        for kind, process in processes.items():
            try:
                process.prepare(subject)
                process.image(look(subject, HD), HD)
                idle = process.idle_share()
                if idle > RESTLESS:
                    raise RuntimeError(f"takes {100 * idle:.0f} % of a processor while it is idle")
                self.versions[kind.name] = process.version()
                process.release()
                found.append(kind)
            except Exception as error:  # whatever a broken installation raises
                self.left_out[kind.name] = reason(error)
                self._processes.pop(kind).close()
        self.kinds = tuple(found)

    def process(self, kind: type[Peer]) -> TracerProcess:
        """The process of one kind of tracer, started once."""
        if kind not in self._processes:
            self._processes[kind] = TracerProcess(kind)
        return self._processes[kind]

    def close(self) -> None:
        """Ends the processes."""
        for process in self._processes.values():
            process.close()
        self._processes.clear()

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
        large = ("1M", "ball 1M", "4M", "scan 2M", "parts 3M") if self.quick else ()
        return [self.subject(name) for name in names if name not in large]

    @property
    def all_kinds(self) -> tuple[type[Peer], ...]:
        """Lucida first, then the peers."""
        return (Lucida, *self.kinds)

    def peer_columns(self, what: str = "ms (times ours)") -> tuple[str, ...]:
        return tuple(f"{kind.name} {what}" for kind in self.kinds)

    @contextmanager
    def tracers(
        self, subject: Subject, threads: int | None = None
    ) -> Iterator[list[TracerProcess]]:
        """Lucida and the peers, ready to trace; their scenes are freed at the end."""
        processes = [self.process(kind) for kind in self.all_kinds]
        try:
            for process in processes:
                process.prepare(subject, threads)
            yield processes
        finally:
            for process in processes:
                process.release()

    def time(
        self, tracers: list[TracerProcess], plan: Plan | None = None, stopwatch: Stopwatch = seconds
    ) -> dict[str, Timing]:
        """Times what was set for each of these, by name."""
        plan = plan or self.plan
        return interleaved({t.name: t.turn(plan, stopwatch) for t in tracers}, plan)

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


def share_that_differs(ours: Hits, theirs: Hits) -> float:
    """The part of the rays for which another primitive was found."""
    return float(np.mean(ours.primitive != theirs.primitive))


def size_text(size: Size) -> str:
    return f"{size[0]}x{size[1]}"
