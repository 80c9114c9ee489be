"""Reads thousands of damaged model, scene, view and lecture files, each in a process of its own.

    python -m tools.attack.mutated_files [--files 6000] [--seed 1] [--keep FOLDER]

Each file must be read, or be refused in one line, within limits of time and memory: no crash, no
hang, no traceback, no warning. What goes wrong is kept, and told with the file's name; the exit
status is 1. On systems without fork there are no limits, and a crash ends the attack.
"""

from __future__ import annotations

import argparse
import math
import os
import random
import re
import shutil
import signal
import sys
import tempfile
import time
import warnings
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from unittest import mock

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # a fork has one thread

from lucida.app.lecture.reading import load_lecture
from lucida.renderer.files import load_scene, load_view
from lucida.renderer.scene import flatten
from lucida.renderer.system.errors import LucidaError
from tools.attack.seed_files import seed_files

MEMORY_BYTES = 1 << 30  # that reading one of these small files may take
TIME_S = 20
LARGEST = 1 << 18  # bytes of a damaged file
LONGEST = 2500  # letters of a refusal
GOOD, REFUSED = "read", "refused"
BESIDE = (".mtl", ".bin")  # files that others name
READERS = ("load_scene", "load_view", "load_lecture")

# What a count, an index or a size may become.
NUMBERS = (
    "0",
    "-1",
    "1",
    "2",
    "255",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "1000000000000",
    "9223372036854775808",
    "1e9",
    "1e38",
    "1e39",
    "1e308",
    "1e999",
    "-1e-320",
    "nan",
    "inf",
    "0.5",
    "9" * 5000,
)
WORDS = (b"", b"\0", b"\xff\xfe", b"\\\n", b"[" * 5000, b"{", b'"', b"'''", b"a." * 40, b"#")
BINARY = (b"\0\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\0\0\xc0\x7f")


def mutated(data: bytes, dice: random.Random) -> bytes:
    """The file with one to eight mistakes."""
    for _ in range(dice.choice((1, 1, 1, 2, 3, 8))):
        data = dice.choice(MUTATIONS)(data, dice)[:LARGEST]
    return data


def _places(data: bytes, dice: random.Random) -> tuple[int, int]:
    first = dice.randrange(len(data) + 1)
    return first, min(len(data), first + dice.choice((1, 2, 4, 16, 200)))


def _other_bytes(data: bytes, dice: random.Random) -> bytes:
    first, last = _places(data, dice)
    return data[:first] + dice.randbytes(last - first) + data[last:]


def _other_bit(data: bytes, dice: random.Random) -> bytes:
    if not data:
        return data
    at = dice.randrange(len(data))
    return data[:at] + bytes([data[at] ^ (1 << dice.randrange(8))]) + data[at + 1 :]


def _cut_off(data: bytes, dice: random.Random) -> bytes:
    return data[: dice.randrange(len(data) + 1)]


def _cut_out(data: bytes, dice: random.Random) -> bytes:
    first, last = _places(data, dice)
    return data[:first] + data[last:]


def _repeated(data: bytes, dice: random.Random) -> bytes:
    first, last = _places(data, dice)
    return data[:last] + data[first:last] * dice.choice((1, 2, 50, 3000)) + data[last:]


def _inserted(data: bytes, dice: random.Random) -> bytes:
    at = dice.randrange(len(data) + 1)
    return data[:at] + dice.choice((*WORDS, *BINARY)) + data[at:]


def _other_number(data: bytes, dice: random.Random) -> bytes:
    """One number in a text becomes another."""
    numbers = list(_NUMBER.finditer(data))
    if not numbers:
        return _other_four_bytes(data, dice)
    first, last = dice.choice(numbers).span()
    return data[:first] + dice.choice(NUMBERS).encode() + data[last:]


def _other_four_bytes(data: bytes, dice: random.Random) -> bytes:
    at = dice.randrange(len(data) // 4 + 1) * 4 + dice.choice((0, 0, 1, 2))
    return data[:at] + dice.choice(BINARY) + data[at + 4 :]


def _other_line(data: bytes, dice: random.Random) -> bytes:
    """A line repeated, left out, or in another's place."""
    lines = data.split(b"\n")
    one, other = dice.randrange(len(lines)), dice.randrange(len(lines))
    what = dice.randrange(3)
    if what == 0:
        most = LARGEST // (len(lines[other]) + 1) + 1
        lines[one:one] = [lines[other]] * min(most, dice.choice((1, 100, 5000)))
    elif what == 1:
        del lines[one]
    else:
        lines[one], lines[other] = lines[other], lines[one]
    return b"\n".join(lines)


_NUMBER = re.compile(rb"[-+]?\d[\d.]*(?:e[-+]?\d+)?")
MUTATIONS: tuple[Callable[[bytes, random.Random], bytes], ...] = (
    _other_bytes,
    _other_bit,
    _cut_off,
    _cut_out,
    _repeated,
    _inserted,
    _other_number,
    _other_number,
    _other_four_bytes,
    _other_line,
)


def read(path: Path) -> str:
    """Reads a file as the program would; what came of it, in words."""
    load: Callable[[Path], Any] = load_scene
    if path.stem.startswith("view"):
        load = load_view
    elif path.stem.startswith("lecture"):
        load = load_lecture
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found = load(path)
            if load is load_scene:
                flatten(found)
        except LucidaError as error:
            return _judged(error)
        except MemoryError:
            return "took more memory than it may"
        except Exception as error:
            return f"{type(error).__name__}: {error}"[:LONGEST]
    return GOOD


def _judged(error: LucidaError) -> str:
    line = str(error)
    if "\n" in line or not line.isprintable():
        return f"not one line: {line!r}"[:LONGEST]
    if len(line) > LONGEST:
        return f"a line of {len(line)} letters: {line[:200]}"
    if "does not fit into memory" in line:
        return "took more memory than it may"
    return REFUSED if error.remedy else f"no remedy: {line}"


def read_apart(path: Path) -> str:
    """The same in a process of its own, within limits of time and memory, where there is fork."""
    if not hasattr(os, "fork"):
        return read(path)
    answer, question = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(answer)
            _limit()
            os.write(question, read(path).encode("utf-8", "backslashreplace"))
        finally:
            os._exit(0)
    os.close(question)
    with os.fdopen(answer, "rb") as pipe:
        said = pipe.read().decode()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status == -signal.SIGALRM:
        return f"took more than {TIME_S} s"
    return f"crashed: {signal.Signals(-status).name}" if status < 0 else said or "said nothing"


def _limit() -> None:
    import resource

    try:  # what is there already is not the file's
        pages = int(Path("/proc/self/statm").read_text().split()[0])
    except OSError:
        pages = 0
    most = pages * resource.getpagesize() + MEMORY_BYTES
    if pages:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.alarm(TIME_S)


def _say(text: str) -> None:
    print(text, flush=True)


def attack(folder: Path, options: argparse.Namespace) -> int:
    """Read damaged files in a folder; return how many were not taken as they should."""
    files, seed, end_s = options.files, options.seed, time.monotonic() + 60 * options.minutes
    dice = random.Random(seed)
    seeds = seed_files()
    for name, content in seeds.items():
        (folder / name).write_bytes(content)
    for name in seeds:
        if not name.endswith(BESIDE) and (answer := read_apart(folder / name)) != GOOD:
            raise AssertionError(f"{name}, which is sound: {answer}")
    sound = folder / next(name for name in seeds if not name.endswith(BESIDE))
    with mock.patch.multiple(__name__, **dict.fromkeys(READERS, mock.Mock(side_effect=KeyError))):
        if read_apart(sound) in (GOOD, REFUSED):
            raise AssertionError("a reader that fails is not noticed: the attack sees nothing")
    counts: Counter[str] = Counter()
    for number in range(files):
        if time.monotonic() > end_s:
            files = number
            break
        name = dice.choice(sorted(seeds))
        path = folder / name
        if name.endswith(BESIDE):  # it is read by whoever names it
            user = "full.obj" if name.endswith(".mtl") else "beside.gltf"
            path.write_bytes(mutated(seeds[name], dice))
            answer = read_apart(folder / user)
        else:
            path = folder / f"{path.stem}-{number}{path.suffix}"
            path.write_bytes(mutated(seeds[name], dice))
            answer = read_apart(path)
        if number % 500 == 499:
            _say(f"{number + 1} ...")
        counts[answer if answer in (GOOD, REFUSED) else "wrong"] += 1
        if answer not in (GOOD, REFUSED):
            kept = folder / f"wrong-{number}-{name}"
            shutil.copy(path, kept)
            _say(f"{kept}: {answer}")
        if path.name == name:
            path.write_bytes(seeds[name])
        else:
            path.unlink()
    _say(f"{files} mutated files: " + ", ".join(f"{n} {what}" for what, n in counts.items()))
    return counts["wrong"]


def main(argv: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--files", type=int, default=6000, help="how many (default: 6000)")
    parser.add_argument("--seed", type=int, help="a random one where none is given")
    parser.add_argument(
        "--minutes", type=float, default=math.inf, help="no further file after that"
    )
    parser.add_argument("--keep", type=Path, help="a folder for the files that go wrong")
    options = parser.parse_args(argv)
    options.seed = random.randrange(1 << 20) if options.seed is None else options.seed
    _say(f"mutated_files: seed {options.seed}")
    if options.keep is not None:
        options.keep.mkdir(parents=True, exist_ok=True)
        return min(1, attack(options.keep, options))
    with tempfile.TemporaryDirectory(prefix="lucida-attack-") as folder:
        wrong = attack(Path(folder), options)
        if wrong:
            print(f"once more with --seed {options.seed} --keep FOLDER to have the files")
        return min(1, wrong)


if __name__ == "__main__":
    sys.exit(main())
