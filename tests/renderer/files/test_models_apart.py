"""Large models in a process of their own: the same objects, the same errors, and its end."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from opened_things import found

from lucida.app.window.files import Files
from lucida.app.window.opening import Opened, OpenedScene
from lucida.renderer.files import load_scene
from lucida.renderer.files.models import subprocess_reader as apart
from lucida.renderer.files.models.models import read_by, read_model
from lucida.renderer.files.models.subprocess_reader import CancelledError, ModelReader, is_large
from lucida.renderer.scene.model import Mesh, SceneObject
from lucida.renderer.scene.texture import is_final
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.pipe import read_value, write_value

PATIENT_S = 120.0
ROOT = Path(__file__).parents[3]
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
PROGRAM = "import time\ndef main(path):\n"


def wait_for(condition: Callable[[], object]) -> None:
    end_s = time.monotonic() + PATIENT_S
    while not condition():
        assert time.monotonic() < end_s, "nothing happened"
        time.sleep(0.01)


@pytest.fixture
def all_large(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every model is read apart."""
    monkeypatch.setattr(apart, "is_large", lambda _: True)


@pytest.fixture
def not_here(all_large: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """And none in this process."""
    monkeypatch.setattr(apart, "read_model", None)


@pytest.fixture
def child(
    tmp_path: Path, all_large: None, monkeypatch: pytest.MonkeyPatch
) -> Callable[[str], None]:
    """Return the program of the process that reads."""
    start = apart.start_child

    def use(program: str) -> None:
        (tmp_path / "other_reader.py").write_text(program)

    def started(python: str, module: str, *arguments: str, output: bool) -> subprocess.Popen:
        return start(python, "other_reader", *arguments, output=output)

    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(apart, "start_child", started)
    return use


def mesh_of(entry: SceneObject) -> Mesh:
    assert isinstance(entry.shape, Mesh)
    return entry.shape


def written(path: Path, content: str | bytes) -> Path:
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


# What comes back.


def test_arrays_come_through_as_they_were_shared_and_final():
    final = np.arange(12, dtype=np.float32).reshape(4, 3)
    final.setflags(write=False)
    value = {
        "twice": (final, final),
        "columns": np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        "empty": np.zeros((0, 3), np.int32),
        "text": "ä",
    }
    stream = io.BytesIO()
    write_value(stream, value)
    stream.seek(0)
    again = read_value(stream)
    first, second = again["twice"]
    assert first is second
    assert is_final(first)
    assert not first.flags.writeable
    np.testing.assert_array_equal(first, final)
    np.testing.assert_array_equal(again["columns"], value["columns"])
    assert (again["empty"].shape, again["empty"].dtype) == ((0, 3), np.int32)
    assert again["text"] == "ä"
    with pytest.raises(EOFError):
        read_value(io.BytesIO(stream.getvalue()[:-1]))
    with pytest.raises(EOFError):
        read_value(io.BytesIO())


def test_a_model_read_apart_is_the_same_model(tmp_path: Path, not_here: None):
    text = "mtllib m.mtl\no one\nusemtl red\n" + TRIANGLE + "o two\nv 0 0 5\nf 1 2 4\n"
    written(tmp_path / "m.mtl", "newmtl red\nKd 1 0 0\n")
    path = written(tmp_path / "two parts.obj", text)
    here, there = read_model(path).objects, ModelReader().read(path).objects
    assert [(e.name, e.material) for e in here] == [(e.name, e.material) for e in there]
    assert len(here) == 2
    for mine, other in zip(map(mesh_of, here), map(mesh_of, there), strict=True):
        for name in ("vertices", "faces", "normals", "transform"):
            np.testing.assert_array_equal(getattr(mine, name), getattr(other, name))
            assert not getattr(other, name).flags.writeable


def test_models_inside_scene_files_are_read_apart_too(tmp_path: Path, not_here: None):
    written(tmp_path / "part.obj", TRIANGLE)
    scene = written(tmp_path / "s.toml", '[[objects]]\ntype = "model"\nfile = "part.obj"\n')
    with read_by(ModelReader().read):
        assert len(load_scene(scene).objects) == 1


# Errors.


@pytest.mark.parametrize("content", ["v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n", None])
def test_errors_come_back_whole(tmp_path: Path, not_here: None, content: str | None):
    path = tmp_path / "a.obj"
    if content is not None:
        written(path, content)
    with pytest.raises(LucidaError) as here:
        read_model(path)
    with pytest.raises(LucidaError) as there:
        ModelReader().read(path)
    assert vars(there.value) == vars(here.value)


def test_a_model_that_memory_is_too_small_for_is_one_line(tmp_path: Path, child):
    child(PROGRAM + "    raise SystemExit(137)\n")  # as if it had been killed
    path = written(tmp_path / "huge.obj", TRIANGLE)
    with pytest.raises(LucidaError, match=r"huge\.obj: was given up.*137.*smaller model") as caught:
        ModelReader().read(path)
    assert "\n" not in str(caught.value)


# Where there can be no process.


def test_without_an_interpreter_models_are_read_here(
    tmp_path: Path, all_large: None, monkeypatch: pytest.MonkeyPatch
):
    def no_child(*_: object, **__: object) -> None:
        raise OSError("no resources")

    path = written(tmp_path / "a.obj", TRIANGLE)
    monkeypatch.setattr(apart, "start_child", no_child)
    assert len(ModelReader().read(path).objects) == 1
    monkeypatch.setattr(apart, "interpreter", lambda: None)
    assert len(ModelReader().read(path).objects) == 1


def test_only_large_files_are_worth_a_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    numbers = written(tmp_path / "a.stl", b"\0" + b"#" * (apart.LARGE_BYTES - 2))
    assert not is_large(numbers)
    with numbers.open("r+b") as file:
        file.truncate(apart.LARGE_BYTES)
    assert is_large(numbers)
    tree = written(tmp_path / "a.gltf", "{}")
    assert not is_large(tree)
    with (tmp_path / "a.bin").open("wb") as file:
        file.truncate(apart.LARGE_BYTES)
    assert is_large(tree)
    assert not is_large(tmp_path / "missing.obj")
    assert not is_large(tmp_path)
    assert not is_large(Path("a\0b.obj"))


# Its end.


def test_cancelling_kills_the_process(tmp_path: Path, child):
    child(PROGRAM + "    time.sleep(9999)\n")
    path, reader = written(tmp_path / "a.obj", TRIANGLE), ModelReader()
    outcome: list[BaseException] = []

    def read() -> None:
        try:
            reader.read(path)
        except BaseException as error:
            outcome.append(error)

    thread = threading.Thread(target=read)
    thread.start()
    wait_for(lambda: reader.process is not None)
    process = reader.process
    assert process is not None
    reader.cancel()
    thread.join(PATIENT_S)
    assert [type(error) for error in outcome] == [CancelledError]
    assert process.returncode not in (0, None)
    assert reader.process is None
    with pytest.raises(CancelledError):  # nothing begins afterwards, large or not
        reader.read(path)


def test_closing_and_cancelling_the_windows_files_ends_the_process(tmp_path: Path, child):
    child(PROGRAM + "    time.sleep(9999)\n")
    path = written(tmp_path / "a.obj", TRIANGLE)
    files = Files(lambda: None, native=False)
    for end in (files.cancel, files.close):
        files.open(str(path))
        wait_for(lambda: files.models.process is not None)
        process = files.models.process
        assert process is not None
        assert files.loading == "a.obj"
        end()
        wait_for(lambda process=process: process.returncode is not None)
        assert process.returncode not in (0, None)
    assert files.poll() is None
    assert files.poll_said() == ["Loading a.obj was cancelled."]
    assert files.message == ""


def test_of_several_that_are_opened_at_once_the_last_one_wins(tmp_path: Path, child, monkeypatch):
    child(PROGRAM + "    time.sleep(9999)\n")
    monkeypatch.setattr(apart, "is_large", lambda path: path.name == "large.obj")
    files = Files(lambda: None, native=False)
    names = ["large.obj", "b.obj", "large.obj", "c.obj", "last.obj"]
    for name in names:  # before the process of the first has begun, too
        files.open(str(written(tmp_path / name, TRIANGLE)))
    came: list[Opened] = []
    wait_for(lambda: (opened := files.poll()) and (came.append(opened) or True))
    wait_for(lambda: not files.busy)
    assert [found(opened, OpenedScene).scene.name for opened in came] == ["last"]
    assert files.poll() is None
    assert files.message == ""
    assert files.poll_said() == [f"Loading {name} was cancelled." for name in names[:-1]]
    files.close()


@pytest.mark.skipif(sys.platform == "win32", reason="a named pipe tells when its writer is gone")
def test_a_killed_parent_takes_the_process_with_it(tmp_path: Path):
    alive = tmp_path / "alive"
    os.mkfifo(alive)
    written(
        tmp_path / "other_reader.py",
        "import time\nfrom lucida.renderer.system.child import end_with_parent\n"
        "def main(path):\n"
        "    end_with_parent()\n"
        f"    held = open({str(alive)!r}, 'w')\n"
        "    held.write('reading'), held.flush()\n"
        "    time.sleep(9999)\n",
    )
    path = written(tmp_path / "a.obj", TRIANGLE)
    parent = subprocess.Popen(
        [
            sys.executable, "-c",
            "from pathlib import Path\n"
            "from lucida.renderer.files.models import subprocess_reader as apart\n"
            "start = apart.start_child\n"
            "apart.is_large = lambda path: True\n"
            "apart.start_child = lambda python, module, *a, output: "
            "start(python, 'other_reader', *a, output=output)\n"
            f"apart.ModelReader().read(Path({str(path)!r}))\n",
        ],
        env=os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"},
    )  # fmt: skip
    try:
        with alive.open() as file:  # opens once the reader has
            assert file.read(7) == "reading"
            parent.kill()
            assert file.read() == ""  # its end
    finally:
        parent.kill()
        parent.wait()
