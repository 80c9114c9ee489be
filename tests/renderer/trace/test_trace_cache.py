"""The cache of compiled kernels: read-only installations, no folder at all, edits, two at once."""

import errno
import os
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from numba.core import caching, event

import lucida
from lucida.renderer.system import compile_note
from lucida.renderer.trace.compile import compiled
from lucida.renderer.trace.compile.cache_folder import find_cache_folder, prune, source_hash

SMALL_KERNEL = """
from lucida.renderer.trace.compile.compiled import kernel


@kernel
def tripled(x):
    return 3 * x
"""
SCRIPT = """
from numba.core import event
from lucida.renderer.trace.compile import cache_folder
from small_kernel import tripled
with event.install_recorder("numba:compile") as compiled:
    assert tripled(4) == 12
print(cache_folder.cache_folder(), not compiled.buffer)
"""


EDITS = """
from pathlib import Path
from lucida.renderer.trace.compile import cache_folder
renderer = Path(cache_folder.__file__).parents[2]
print(cache_folder.cache_folder())
for edited in (
    "trace/reference/intersect.py", "trace/reference/vectors.py", "scene/flat.py",
    "images/shared_numbers.py",
):
    with (renderer / edited).open("a") as text:
        text.write(chr(10))
    cache_folder.find_cache_folder.cache_clear()
    print(cache_folder.cache_folder())
"""


@pytest.fixture
def installation(tmp_path):
    """Copy the package, which cannot cache beside itself here: the folder's name is taken. Beside
    it lies a module with a kernel that takes no time to compile.
    """
    package = tmp_path / "installation" / "lucida" / "renderer"
    source = Path(lucida.__file__).parent
    shutil.copytree(source, package.parent, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "trace" / "__pycache__").write_text("")
    (package.parents[1] / "small_kernel.py").write_text(SMALL_KERNEL)
    return package


def start(installation, cache, script=SCRIPT):
    env = {name: text for name, text in os.environ.items() if not name.startswith("NUMBA_")}
    env |= {
        "PYTHONPATH": str(installation.parents[1]),
        "HOME": str(cache),
        "XDG_CACHE_HOME": str(cache),
        "LOCALAPPDATA": str(cache),
    }
    return subprocess.Popen(
        [sys.executable, "-c", script], cwd=installation.parents[1], env=env, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


def finish(process):
    out, err = process.communicate()
    assert process.returncode == 0, err
    assert err == ""
    return out.strip()


def test_a_read_only_installation_caches_for_the_user(installation, tmp_path):
    cache = tmp_path / "cache"
    for process in [start(installation, cache) for _ in range(2)]:  # both compile, at once
        folder = finish(process).rsplit(" ", 1)[0]
        assert Path(folder).is_relative_to(cache)
    assert Path(folder).name != source_hash()  # of the same sources at another place

    # An edit of any file that kernels consist of leads to another folder.
    told, *folders = finish(start(installation, cache, SCRIPT + EDITS)).splitlines()
    assert told == f"{folder} True"
    assert folders[0] == folder and len(set(folders)) == 5


def test_a_damaged_file_costs_compiling_at_once_and_at_the_next_start(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(compiled, "cache_folder", lambda: find_cache_folder.__wrapped__()[0])
    monkeypatch.setattr(compile_note, "_note", "")
    compiles = []
    for damaged in ("none", "none", "*.nb?", "none", "none"):
        monkeypatch.setattr(compiled, "_has_failed", threading.Event())  # as in another process
        for file in tmp_path.rglob(damaged):
            file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
        with event.install_recorder("numba:compile") as found:
            assert compiled.kernel(tripled)(4) == 12
        compiles.append(bool(found.buffer))
    assert compiles == [True, False, True, True, False]


def test_without_a_folder_kernels_are_compiled_each_time(monkeypatch):
    monkeypatch.setattr(compiled, "cache_folder", lambda: None)
    assert compiled.kernel(tripled)(4) == 12
    assert not compiled.is_cached()


def test_a_kernel_that_cannot_be_stored_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr(compile_note, "_note", "")  # which counts for a whole process
    monkeypatch.setattr(compiled, "_has_failed", threading.Event())
    monkeypatch.setattr(compiled, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(caching.Cache, "save_overload", full)
    assert compiled.kernel(tripled)(4) == 12
    assert not compiled.is_cached()
    assert compile_note.note() == compile_note.EACH_TIME
    compile_note.begin(kept=True)  # another kernel's
    assert compile_note.note() == compile_note.EACH_TIME


def full(self, signature, data):
    raise OSError(errno.ENOSPC, "No space left on device")


def tripled(x):
    return 3 * x


def test_old_folders_are_pruned(tmp_path):
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
