"""Kills processes while they save: each file is the old one or the new one, never a part of one.

    python -m tools.attack.kill_saves --times 1000
    python -m tools.attack.kill_saves --times 50 --seed 3

A process saves a picture, an array, a scene, a view, a session and the recent files over and over,
and is killed after a random time. Then each file must be whole, and not older than it was; the
session's place must be free; and what was left unfinished must go with a save a day later.
Needs fork.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import os
import random
import signal
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np

from lucida.app.state.app_state import AppState
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.ui.recent import RecentFiles
from lucida.app.window.session_store import take_place
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene, load_view, save_scene, save_view
from lucida.renderer.images import write_image, write_picture
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene import View
from lucida.renderer.system import atomic

ROUNDS = 3.0  # of saving, at most, before a process is killed
PADDING = 20_000  # characters in a session
SIDE = 64


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="kill_saves", description=__doc__.splitlines()[0])
    parser.add_argument("--times", type=int, default=1000, metavar="N", help="kills (default 1000)")
    parser.add_argument("--seed", type=int, help="of the random times; a random one by default")
    parser.add_argument(
        "--minutes", type=float, default=math.inf, help="no further kill after that"
    )
    arguments = parser.parse_args(argv)
    if not hasattr(os, "fork"):
        print("kill_saves: needs fork", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory(prefix="lucida-attack-") as folder:
        seed = random.randrange(1 << 20) if arguments.seed is None else arguments.seed
        print(f"kill_saves: seed {seed}", flush=True)
        chance = random.Random(seed)
        return attack(Path(folder), arguments.times, chance, arguments.minutes)


def attack(folder: Path, times: int, chance: random.Random, minutes: float = math.inf) -> int:
    """Kill so many times, or minutes; return the exit status: 1 as soon as a file is not whole."""
    end_s = time.monotonic() + 60 * minutes
    known: dict[str, int] = {}
    saved = 0
    round_s = _round_s(folder / "elsewhere")
    if missed := _missed(folder / "elsewhere"):
        print(f"a torn {missed} is not noticed: the attack sees nothing")
        return 1
    for kill in range(times):
        if time.monotonic() > end_s:
            times = kill
            break
        process = _start(folder, max(known.values(), default=0) + 1)
        time.sleep(chance.uniform(0.0, ROUNDS * round_s))
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        try:
            numbers = read_all(folder)
        except Exception as error:
            print(f"kill {kill}: {type(error).__name__}: {error}")
            return 1
        older = [name for name, number in known.items() if numbers.get(name, -1) < number]
        if older:
            print(f"kill {kill}: lost, or older than before: {', '.join(older)}")
            return 1
        saved += numbers != known
        known = numbers
    found, left = len(_parts(folder)), _clear(folder)
    rounds = max(known.values(), default=0)
    print(
        f"{times} kills, {saved} of them after something was saved, in {rounds} rounds: "
        f"every file whole; {found} unfinished files were left, {len(left)} a day later"
    )
    return 1 if left else 0


def save_all(folder: Path, number: int, recent: RecentFiles) -> None:
    """One round: what each file holds tells its number, from beginning to end."""
    colour = np.full((SIDE, SIDE, 3), number % 256, np.uint8)
    write_picture(folder / "picture.png", colour)
    depth = np.full((SIDE, SIDE), number, np.float32)
    write_image(folder / "numbers.npy", Frame((SIDE, SIDE), depth=depth), "depth")
    scene = load_scene("spheres")
    view = View(Camera(eye=(number, number, number)))
    save_view(folder / "view.toml", view)
    save_scene(folder / "scene.toml", scene, view)
    recent.add(f"/{number}/" + "x" * 1000 + f"/{number}")
    place = take_place(folder)
    assert place is not None
    assert place.path.name == "session-1.json", "the place of a dead process is not free"
    arrangement = Arrangement(focused=f"{number} " + "x" * PADDING + f" {number}")
    place.save(to_bytes(session_of(AppState.for_scene(scene), arrangement)))
    place.release()


def read_all(folder: Path) -> dict[str, int]:
    """The numbers of the files that are there, by name. Raises whatever is wrong with one."""
    from PIL import Image

    numbers = {}
    if (folder / "picture.png").exists():
        picture = np.asarray(Image.open(folder / "picture.png").convert("RGB"))
        assert picture.shape == (SIDE, SIDE, 3)
        assert (picture == picture[0, 0]).all()
    if (folder / "numbers.npy").exists():
        array = np.load(folder / "numbers.npy")
        assert array.shape == (SIDE, SIDE)
        assert (array == array[0, 0]).all()
        numbers["numbers.npy"] = int(array[0, 0])
    for name, load in (("view.toml", load_view), ("scene.toml", lambda p: load_scene(p).view)):
        if (folder / name).exists():
            eye = load(folder / name).camera.eye
            assert eye[0] == eye[1] == eye[2]
            numbers[name] = int(eye[0])
    if (folder / "session-1.json").exists():
        session = from_bytes((folder / "session-1.json").read_bytes())
        first, padding, last = session.arrangement.focused.split()
        assert padding == "x" * PADDING
        assert first == last
        numbers["session-1.json"] = int(first)
    if (folder / "recent.json").exists():
        for path in msgspec.json.decode((folder / "recent.json").read_bytes(), type=list[str]):
            _, first, padding, last = path.split("/")
            assert (first, padding) == (last, "x" * 1000)
            numbers["recent.json"] = max(int(first), numbers.get("recent.json", 0))
    return numbers


def _round_s(folder: Path) -> float:
    """Return the time of a round of saving, in processes that have imported what they need."""
    folder.mkdir()
    recent = RecentFiles(folder)
    save_all(folder, 1, recent)
    start_s = time.monotonic()
    save_all(folder, 2, recent)
    return time.monotonic() - start_s


def _missed(folder: Path) -> str:
    """Plant faults that must be noticed: each file in turn is cut in its middle.

    Return the name of one that is taken for whole.
    """
    for path in sorted(path for path in folder.iterdir() if path.suffix != ".lock"):
        data = path.read_bytes()
        path.write_bytes(data[: len(data) // 2])
        with contextlib.suppress(Exception):
            read_all(folder)
            return path.name
        path.write_bytes(data)
    return ""


def _start(folder: Path, first: int) -> int:
    """A process that saves until it is killed; returns when it is about to."""
    reading, writing = os.pipe()
    process = os.fork()
    if process:
        os.close(writing)
        with os.fdopen(reading, "rb") as pipe:
            pipe.read(1)
        return process
    try:
        recent = RecentFiles(folder)
        os.write(writing, b"!")
        while True:
            save_all(folder, first, recent)
            first += 1
    except BaseException as error:
        print(f"saving failed: {type(error).__name__}: {error}", flush=True)
    finally:
        os._exit(1)


def _clear(folder: Path) -> list[Path]:
    """Save once more, as if a day had passed; return what is still left unfinished."""
    for part in _parts(folder):
        os.utime(part, (0, 0))
    process = os.fork()
    if process == 0:
        with atomic.atomic_write(folder / "last") as file:
            file.write(b"x")
        os._exit(0)
    os.waitpid(process, 0)
    return _parts(folder)


def _parts(folder: Path) -> list[Path]:
    return list(folder.glob(".*.part"))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
