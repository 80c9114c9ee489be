"""Where compiled kernels are kept: read-only installations, no place at all, edits, two at once."""

from __future__ import annotations

import errno
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from numba.core import caching

import renderer
from renderer import compile_note
from renderer.trace.compile import compiled
from renderer.trace.compile.cache_folder import prune
from renderer.trace.jobs.compile_child import is_copied

HANG_S = 280
PROCESSES = 1 if is_copied() else 3  # that a Tracer starts to compile its parts
SCRIPT = """
from renderer.camera import Camera
from renderer.scene.model import Scene, SceneObject, Sphere
from renderer.trace import Tracer
tracer = Tracer(Scene((SceneObject(Sphere((0, 0, -3))),)), method="reference")  # the small kernel
frame = tracer.render(Camera(), (5, 5), ("depth",))
assert frame.depth[2, 2] == 2, frame.depth
from renderer.trace.compile import cache_folder
from renderer.trace.scalar.kernel import trace_image as kernel
print(cache_folder.cache_folder(), sum(kernel.stats.cache_hits.values()))
"""


@pytest.fixture
def installation(tmp_path: Path) -> Path:
    """A copy of the package that cannot cache beside itself: the folder's name is taken."""
    package = tmp_path / "installation" / "renderer"
    source = Path(renderer.__file__).parent
    shutil.copytree(source, package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "trace" / "__pycache__").write_text("")
    return package


def start(installation: Path, cache: Path, script: str = SCRIPT) -> subprocess.Popen:
    env = {name: text for name, text in os.environ.items() if not name.startswith("NUMBA_")}
    env |= {
        "PYTHONPATH": str(installation.parent),
        "PYTHONDONTWRITEBYTECODE": "1",
        "HOME": str(cache),
        "XDG_CACHE_HOME": str(cache),
        "LOCALAPPDATA": str(cache),
    }
    return subprocess.Popen(
        [sys.executable, "-c", script], cwd=installation.parent, env=env, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


def finish(process: subprocess.Popen) -> str:
    out, err = process.communicate(timeout=HANG_S)
    assert process.returncode == 0, err
    assert err == ""
    return out.strip()


def test_a_read_only_installation_caches_for_the_user(installation: Path, tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    for process in [start(installation, cache) for _ in range(2)]:  # both compile, at once
        folder = finish(process).rsplit(" ", 1)[0]
        assert Path(folder).is_relative_to(cache)
    assert finish(start(installation, cache)) == f"{folder} 1"

    # A damaged file costs compiling again, and is replaced.
    for file in Path(folder).rglob("*.nb?"):
        file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    assert finish(start(installation, cache)) == f"{folder} 0"
    assert finish(start(installation, cache)) == f"{folder} 1"

    # An edit of any file that kernels consist of leads to another folder.
    shown = "from renderer.trace.compile import cache_folder; print(cache_folder.cache_folder())"
    folders = {folder, finish(start(installation, cache, shown))}
    assert len(folders) == 1
    edits = "trace/scalar/intersect.py", "trace/scalar/vectors.py", "scene/flat.py"
    for edited in (*edits, "shared_numbers.py"):
        with (installation / edited).open("a") as text:
            text.write("\n")
        folders.add(finish(start(installation, cache, shown)))
    assert len(folders) == 5


def test_with_nowhere_to_write_kernels_are_compiled_each_time(
    installation: Path, tmp_path: Path
) -> None:
    cache = tmp_path / "file"
    cache.write_text("no folder can be made in here")
    assert finish(start(installation, cache / "below")) == "None 0"


FULL = """
import errno, sys
from numba.core import caching
mended = sys.argv[1:] == ["mended"]
def full(self, name, data):
    raise OSError(errno.ENOSPC, "No space left on device")
if not mended:
    caching.IndexDataCacheFile._save_data = full
from renderer.trace.jobs import compile_child
compile_child.end_with_parent = lambda: None  # whose input would be at its end
compile_child.main("trees")
"""


def test_what_a_full_disk_cannot_keep_is_not_said_to_be_kept(
    installation: Path, tmp_path: Path
) -> None:
    process = start(installation, tmp_path, FULL)
    assert process.communicate(timeout=HANG_S) == ("", "")
    assert process.returncode == 1
    room = "import sys; sys.argv.append('mended')" + FULL
    assert finish(start(installation, tmp_path, room)) == ""


def test_what_cannot_be_kept_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_note, "_note", "")  # which counts for a whole process
    monkeypatch.setattr(compiled, "cache_folder", lambda: tmp_path)
    # Where numba writes: a disk that is full is told from there.
    monkeypatch.setattr(caching.IndexDataCacheFile, "_save_data", full)
    assert compiled.kernel(tripled)(4) == 12
    assert compile_note.note() == compile_note.EACH_TIME
    compile_note.begin(kept=True)  # another kernel's
    assert compile_note.note() == compile_note.EACH_TIME


def full(self: object, name: str, data: object) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


def tripled(x):
    return 3 * x


def test_old_folders_are_pruned(tmp_path: Path) -> None:
    for age in range(10):
        folder = tmp_path / f"old{age}"
        folder.mkdir()
        (folder / "kernel.nbi").write_text("x")
        stamp = time.time() - 86400 * (age + 1)
        os.utime(folder, (stamp, stamp))
    for name in ("young", "used"):
        (tmp_path / name).mkdir()
    prune(tmp_path, tmp_path / "used")
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {"used", "young", "old0", "old1", "old2"}


COUNTED = """
import subprocess, sys, time
started = []
class Counted(subprocess.Popen):
    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        started.append(self)
subprocess.Popen = Counted
from renderer.trace.jobs import precompile
precompile.default_threads = lambda: 2
from renderer.camera import Camera
from renderer.scene.model import Scene, SceneObject, Sphere
from renderer.trace import Tracer
tracer = Tracer(Scene((SceneObject(Sphere((0, 0, -3))),)))
"""


def test_kernels_are_compiled_in_processes_of_their_own(installation: Path, tmp_path: Path) -> None:
    script = COUNTED + (
        "frame = tracer.render(Camera(), (5, 5), ('depth',))\n"
        "assert frame.depth[2, 2] == 2, frame.depth\n"
        "from renderer.trace.packets.kernel import trace_packets as kernel\n"
        "print([p.poll() for p in started], sum(kernel.stats.cache_misses.values()))"
    )
    ended = f"{[0] * PROCESSES} 0"
    assert finish(start(installation, tmp_path / "cache", script)) == ended
    assert finish(start(installation, tmp_path / "cache", script)) == "[] 0"  # all is there


@pytest.mark.parametrize("broken", ["sys.executable = None", "sys.executable = '/none/python'"])
def test_without_an_interpreter_kernels_are_compiled_here(
    installation: Path, tmp_path: Path, broken: str
) -> None:
    script = f"{COUNTED}{broken}\n" + (
        "frame = tracer.render(Camera(), (5, 5), ('depth',))\n"
        "assert frame.depth[2, 2] == 2, frame.depth\n"
        "print(len(started))"
    )
    assert finish(start(installation, tmp_path / "cache", script)) == "0"


def test_closing_a_tracer_ends_the_compiling_processes(installation: Path, tmp_path: Path) -> None:
    script = COUNTED + (
        "job = tracer.start(Camera(), (5, 5))\n"
        f"while len(started) < {PROCESSES}: time.sleep(0.01)\n"
        "tracer.close()\n"
        "assert not job.result().complete\n"
        "print(all(p.returncode for p in started), started[0].pid)"
    )
    ended, group = finish(start(installation, tmp_path / "cache", script)).split()
    assert ended == "True"
    if is_copied():
        assert_ends(int(group))


COPIED = """
import os, time
from renderer.child import interpreter, start_child
child = start_child(interpreter(), "renderer.trace.jobs.compile_child", "walk", "trees", "write")
def copies():
    with open(f"/proc/{child.pid}/task/{child.pid}/children") as file:
        return len(file.read().split())
while copies() < 3: time.sleep(0.01)
print(child.pid)
"""


@pytest.mark.skipif(not is_copied(), reason="each part has a process of its own")
def test_copies_of_a_compiling_process_end_with_its_parent(
    installation: Path, tmp_path: Path
) -> None:
    """Which is killed, or just ends, while all of them are at work."""
    assert_ends(int(finish(start(installation, tmp_path / "cache", COPIED))))


def assert_ends(group: int) -> None:
    """That all processes of a group do."""
    end_s = time.monotonic() + HANG_S
    while time.monotonic() < end_s:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.02)
    raise AssertionError("some are still there")


@pytest.mark.skipif(sys.platform == "win32", reason="kills by POSIX signals")
def test_compiling_processes_end_with_a_killed_parent(installation: Path, tmp_path: Path) -> None:
    script = COUNTED + (
        "job = tracer.start(Camera(), (5, 5))\n"
        f"while len(started) < {PROCESSES}: time.sleep(0.01)\n"
        "print(*(p.pid for p in started), flush=True)\n"
        "job.wait()"
    )
    process = start(installation, tmp_path / "cache", script)
    assert process.stdout is not None
    children = [int(text) for text in process.stdout.readline().split()]
    process.kill()
    process.communicate(timeout=HANG_S)
    assert len(children) == PROCESSES
    end_s = time.monotonic() + HANG_S
    while any(map(is_running, children)):
        assert time.monotonic() < end_s
        time.sleep(0.05)
    assert not list((tmp_path / "cache").rglob("*.done"))


def is_running(pid: int) -> bool:
    """Whether a process is at work; one that waits for its parent to notice its end is not."""
    try:
        os.kill(pid, 0)
        state = Path(f"/proc/{pid}/stat")
        return not state.exists() or state.read_text().rpartition(")")[2].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False
