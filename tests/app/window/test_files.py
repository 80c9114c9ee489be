"""Recent files, folders, pictures: what the window does with files, without a window."""

import json
import threading

import numpy as np
import pytest
from opened_things import found
from waiting import PATIENT_S, wait_for

from lucida.app.ui.recent import MOST, RecentFiles
from lucida.app.window.canvas import Target
from lucida.app.window.capture import cut, free_path
from lucida.app.window.files import Files
from lucida.app.window.opening import OpenedScene, OpenedView, open_sources
from lucida.renderer.files import load_scene, save_view, scene_parts
from lucida.renderer.files.scene_parts import BoxTable
from lucida.renderer.scene import shapes
from lucida.renderer.system.errors import LucidaError

# Recent files.


def paths(recent):
    return [str(path) for path in recent.entries]


def test_the_newest_file_stands_first_and_the_list_ends(tmp_path):
    recent = RecentFiles(tmp_path)
    names = [str(tmp_path / f"{number}.obj") for number in range(MOST + 3)]
    for name in names:
        recent.add(name)
    recent.add(names[5])
    assert paths(recent)[0] == names[5]
    again = RecentFiles(tmp_path)
    assert paths(again)[:3] == [names[5], names[-1], names[-2]]
    assert len(paths(again)) == MOST
    again.clear()
    assert again.entries == ()
    assert json.loads((tmp_path / "recent.json").read_bytes()) == []


def test_two_windows_share_the_list(tmp_path):
    one, other = RecentFiles(tmp_path), RecentFiles(tmp_path)
    one.add("/a.obj")
    other.add("/b.obj")
    one.look()
    assert paths(one) == ["/b.obj", "/a.obj"]


@pytest.mark.parametrize("content", [b"", b"{", b'{"a": 1}', b"[1, 2]", b"[" * 9999, b"\xff"])
def test_a_broken_list_is_an_empty_one(tmp_path, content):
    (tmp_path / "recent.json").write_bytes(content)
    recent = RecentFiles(tmp_path)
    recent.add("/a.obj")
    assert json.loads((tmp_path / "recent.json").read_bytes()) == ["/a.obj"]


# Folders.


# Several sources at once.


def test_of_several_files_the_first_scene_and_the_first_view_are_taken(tmp_path):
    save_view(tmp_path / "view.toml", load_scene("canonical").view)
    (tmp_path / "broken.obj").write_text("nothing")
    view, broken = str(tmp_path / "view.toml"), str(tmp_path / "broken.obj")
    opened = open_sources([view, broken, "spheres", "columns"])
    assert found(opened, OpenedScene).scene.name == "spheres"
    assert found(opened, OpenedView).view == load_scene("canonical").view
    assert opened.sources == (view, "spheres")
    assert len(opened.problems) == 1
    assert "broken.obj" in opened.problems[0]
    with pytest.raises(LucidaError, match=r"broken\.obj"):
        open_sources([broken])


# Pictures.


class Framebuffer:
    """moderngl's, as far as pictures need it: rows from below."""

    def __init__(self, pixels):
        self.pixels = pixels

    def read(self, viewport, components, alignment):
        assert (viewport, components, alignment) == ((0, 0, 7, 5), 3, 1)
        return self.pixels[::-1].tobytes()


PIXELS = np.arange(5 * 7 * 3, dtype=np.uint8).reshape(5, 7, 3)
TARGET = Target(Framebuffer(PIXELS), (7, 5))


def test_a_name_that_is_taken_gets_a_number(tmp_path):
    path = tmp_path / "lucida.png"
    assert free_path(path) == path
    path.write_bytes(b"taken")
    assert free_path(path).name == "lucida-2.png"
    (tmp_path / "lucida-2.png").symlink_to(tmp_path / "nowhere")  # writing would follow it
    assert free_path(path).name == "lucida-3.png"


def polled(files):
    files.poll()
    return files.poll_said()


def test_a_cut_has_a_pixel_at_least():
    assert cut(PIXELS, (-9, -9, 99, 99)).shape == (5, 7, 3)
    assert cut(PIXELS, (3, 3, 3, 3)).shape == (1, 1, 3)
    assert cut(PIXELS, (99, 99, 120, 120)).shape == (1, 1, 3)


def test_a_scene_that_is_cancelled_is_not_built_to_its_end(tmp_path, monkeypatch):
    path = tmp_path / "boxes.toml"
    path.write_text("[[objects]]\ntype = 'box'\n" * 500)
    built, gate, box = [], threading.Event(), shapes.box

    def slow(size):
        built.append(threading.current_thread())
        gate.wait(PATIENT_S)
        return box(size)

    # No public way makes reading a built-in shape slow.
    _, *more = scene_parts._SHAPES[BoxTable]
    monkeypatch.setitem(scene_parts._SHAPES, BoxTable, (slow, *more))
    files = Files(lambda: None)
    files.open(str(path))
    wait_for(lambda: bool(built))
    files.cancel()
    gate.set()
    wait_for(lambda: not built[0].is_alive())
    assert len(built) == 1
    assert files.poll() is None
    assert files.poll_said() == ["Loading boxes.toml was cancelled."]
    files.close()
