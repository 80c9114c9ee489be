"""Files whose names are not UTF-8, not Latin, or not what one would show: opened, remembered,
told."""

import io
import os
import subprocess
import sys
from types import SimpleNamespace

import msgspec
import pytest

from lucida.app.state.app_state import AppState
from lucida.app.state.paths import is_unicode, restored, stored
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.ui.background import Background
from lucida.app.ui.recent import RecentFiles
from lucida.app.ui.toasts import Toasts
from lucida.app.window import process
from lucida.app.window.files import Files
from lucida.app.window.opening import OpenedScene, open_sources
from lucida.renderer.files import load_scene, save_scene
from lucida.renderer.system.errors import LucidaError, describe, one_line

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
NAMES = (
    *(b"caf\xe9.obj", b"\xff\xfe\n\x1b[31m.obj", b"a  b.obj"),
    *(name.encode() for name in ("ü ⟂ 🎥.obj", "场景 一.obj", "مشهد أول.obj")),
)

pytestmark = pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names are Unicode")


@pytest.fixture(params=NAMES, ids=range(len(NAMES)))
def model(request, tmp_path):
    path = os.path.join(os.fsencode(tmp_path), request.param)
    with open(path, "w") as file:
        file.write(TRIANGLE)
    return os.fsdecode(path)


def is_shown(text):
    """Return True if windows and terminals show the name as it is."""
    return text.isprintable() and is_unicode(text)


def test_what_is_shown_is_printable_and_what_is_kept_comes_back(model):
    assert is_shown(one_line(model))
    assert is_unicode(stored(model))
    assert restored(stored(model)) == model
    assert restored(msgspec.json.decode(msgspec.json.encode(stored(model)))) == model
    assert one_line("caf\udce9") == r"caf\xe9"


def test_the_scene_of_such_a_file_has_a_name_to_show(model, tmp_path):
    scene = load_scene(model)
    assert is_shown(scene.name)
    assert all(is_shown(entry.name) for entry in scene.objects)
    save_scene(tmp_path / "copy.toml", load_scene("spheres"))
    if is_unicode(model):  # TOML is UTF-8
        save_scene(tmp_path / "copy.toml", scene)
        assert len(load_scene(tmp_path / "copy.toml").objects) == 1
        return
    with pytest.raises(LucidaError, match="is not UTF-8") as caught:
        save_scene(tmp_path / "copy.toml", scene)
    assert is_shown(str(caught.value))
    assert load_scene(tmp_path / "copy.toml").name == "spheres"  # what was there


def test_it_is_among_the_recent_files(model, tmp_path):
    recent = RecentFiles(tmp_path / "settings")
    recent.add(model)
    (path,) = RecentFiles(tmp_path / "settings").entries
    assert str(path) == model


def test_it_comes_back_with_the_session(model):
    state = AppState.for_scene(load_scene(model))
    session = from_bytes(to_bytes(session_of(state, Arrangement())))
    assert session.source == model
    assert len(load_scene(session.source).objects) == 1


def test_files_loads_it_and_tells_it(model, monkeypatch):
    waiting = []
    monkeypatch.setattr(Background, "submit", lambda _, work: waiting.append(work))
    files = Files(lambda: None)
    files.open(model)
    monkeypatch.setattr(Background, "busy", True)
    assert is_shown(files.loading)
    monkeypatch.undo()
    assert open_sources([model]).find(OpenedScene) is not None
    os.unlink(model)
    with pytest.raises(LucidaError) as caught:
        open_sources([model])
    assert is_shown(describe(caught.value))
    assert is_shown(describe(OSError(2, "No such file", model)))
    files.close()


def test_a_notification_s_name_is_printable():
    toasts = Toasts()
    toasts.add("Saved /tmp/\udcff.png.")
    assert toasts.texts == [r"Saved /tmp/\xff.png."]


@pytest.mark.parametrize("encoding", ["utf-8", "ascii", "latin-1"])
def test_streams_take_any_text(encoding, monkeypatch):
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors="strict")
    monkeypatch.setattr(sys, "stdout", stream)
    process.open_streams()
    print("caf\udce9 ⟂ 🎥")
    stream.flush()
    assert b"caf" in stream.buffer.getvalue()


def test_names_that_are_dropped_are_decoded_as_files_names_are(monkeypatch):
    from lucida.app.window import platform

    dropped = []
    window = SimpleNamespace()
    given = []
    library = SimpleNamespace(glfwSetDropCallback=lambda _, call: given.append(call))
    monkeypatch.setattr(platform.glfw, "get_current_context", lambda: window)
    # The binding's library itself, which the platform calls too: the binding takes all for UTF-8.
    monkeypatch.setattr(platform.glfw, "_glfw", library)
    monkeypatch.setattr(platform.glfw, "_GLFWdropfun", lambda call: call)
    platform.on_drop(dropped.append)
    given[0](window, 2, [b"/a/caf\xe9.obj", "/b/é.obj".encode()])
    assert dropped == [["/a/caf\udce9.obj", "/b/é.obj"]]


@pytest.mark.parametrize("model", [NAMES[1], NAMES[-1]], indirect=True)
def test_commands_name_it_on_any_terminal(model):
    environment = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    run = (
        "import os, sys; from lucida.app.cli import main; line = ['scene', sys.argv[1]]; "
        "main(line); os.unlink(line[1]); sys.exit(main(line))"
    )
    command = [sys.executable, "-c", run, model]
    out = subprocess.run(command, env=environment, capture_output=True)
    assert b"1 object" in out.stdout
    assert out.returncode == 2
    assert out.stderr.count(b"\n") == 1
    assert b"does not exist" in out.stderr
