"""Files that are replaced whole: long names, and what a killed process leaves behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from renderer.atomic import atomic_write

if sys.platform != "win32":
    import fcntl

ROOT = Path(__file__).parents[2]
# Writes half of a file, says so, and waits to be killed. Its argument: may files be without a name?
WRITER = """
import os, sys, time
from renderer import atomic
if sys.argv[2] == "named" and hasattr(os, "O_TMPFILE"):
    del os.O_TMPFILE
with atomic.atomic_write(sys.argv[1]) as file:
    file.write(b"half")
    file.flush()
    print("half", flush=True)
    time.sleep(600)
"""


@pytest.fixture(params=["unnamed", "named"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> str:
    """How unfinished files are kept: both have to do the same."""
    if request.param == "named":
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    else:
        with atomic_write(tmp_path.parent / "probe"):
            if list(tmp_path.parent.glob(".lucida-*.part")):
                pytest.skip("every file has a name here")
    return request.param


def write(path: Path, content: bytes) -> None:
    with atomic_write(path) as file:
        file.write(content)


@pytest.fixture
def writer(way: str, tmp_path: Path):
    """Starts a process that writes half of tmp_path/"file" and waits."""
    processes = []

    def start() -> subprocess.Popen:
        process = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(tmp_path / "file"), way],
            env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.PIPE,
        )  # fmt: skip
        processes.append(process)
        assert process.stdout is not None
        assert process.stdout.readline() == b"half\n"
        return process

    yield start
    for process in processes:
        process.kill()
        process.wait()
        process.stdout.close()


def names(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


@pytest.mark.parametrize("name", ["ä" * 127 + "x", "\U0001f4f7" * 63 + ".tx", "x" * 255])
def test_names_as_long_as_names_can_be(way: str, tmp_path: Path, name: str) -> None:
    assert len(os.fsencode(name)) == 255
    for content in (b"one", b"two"):
        write(tmp_path / name, content)
        assert names(tmp_path) == [name]
        assert (tmp_path / name).read_bytes() == content


def test_both_ways_leave_the_same_file(way: str, tmp_path: Path) -> None:
    (tmp_path / "plain").write_bytes(b"")
    write(tmp_path / "new", b"x")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "plain").stat().st_mode
    assert (tmp_path / "new").stat().st_nlink == 1
    (tmp_path / "plain").chmod(0o640)
    write(tmp_path / "plain", b"y")
    assert (tmp_path / "plain").stat().st_mode & 0o777 == 0o640
    assert names(tmp_path) == ["new", "plain"]


def test_an_exception_leaves_nothing(way: str, tmp_path: Path) -> None:
    def half() -> None:
        with atomic_write(tmp_path / "file") as file:
            file.write(b"half")
            file.flush()
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        half()
    assert names(tmp_path) == []


@pytest.mark.skipif(sys.platform == "win32", reason="kills by POSIX signals")
def test_what_a_killed_process_leaves_goes_at_the_next_write(way, writer, tmp_path: Path) -> None:
    process = writer()
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert len(names(tmp_path)) == (way == "named")
    write(tmp_path / "another", b"x")
    assert names(tmp_path) == ["another"]


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's locks")
def test_what_another_process_is_writing_stays(way, writer, tmp_path: Path) -> None:
    writer()
    before = names(tmp_path)
    write(tmp_path / "another", b"x")
    assert names(tmp_path) == sorted([*before, "another"])


def test_what_is_not_ours_stays(tmp_path: Path) -> None:
    kept = [".hidden.part", "film.part", ".lucida-notes", "lucida-1.part"]
    for name in kept:
        (tmp_path / name).write_bytes(b"")
    (tmp_path / "elsewhere").write_bytes(b"")
    (tmp_path / ".lucida-0.part").symlink_to("elsewhere")
    (tmp_path / ".lucida-1.part").mkdir()
    write(tmp_path / "new", b"x")
    assert set(names(tmp_path)) >= {*kept, "elsewhere", "new", ".lucida-1.part"}


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's locks")
@pytest.mark.parametrize("removed", [True, False])
def test_a_file_that_was_taken_for_a_dead_process_s_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, removed: bool
) -> None:
    """Between making and locking it, another process may have removed or locked it."""
    monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    lock, taken = fcntl.flock, []

    def late(descriptor: int, how: int) -> None:
        if not taken:
            taken.extend(tmp_path.glob(".lucida-*.part"))
            if not removed:
                raise BlockingIOError
            taken[0].unlink()
        lock(descriptor, how)

    monkeypatch.setattr(fcntl, "flock", late)
    write(tmp_path / "file", b"x")
    assert len(taken) == 1
    taken[0].unlink(missing_ok=True)
    assert (tmp_path / "file").read_bytes() == b"x"
    assert names(tmp_path) == ["file"]


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX's locks")
def test_a_file_system_without_locks(way: str, tmp_path: Path, monkeypatch) -> None:
    def none(descriptor: int, how: int) -> None:
        raise OSError(95, "not supported")

    monkeypatch.setattr(fcntl, "flock", none)
    (tmp_path / ".lucida-0.part").write_bytes(b"in use, for all that we know")
    write(tmp_path / "file", b"x")
    assert (tmp_path / "file").read_bytes() == b"x"
    assert names(tmp_path) == [".lucida-0.part", "file"]
