"""The scene in hand: saving what was changed, and what is dropped on it."""

from objects_window import (
    CTRL,
    SCENE,
    enter,
    item,
    opened,
)
from window_driver import Key

from lucida.app.instruments.objects.choosing import chosen
from lucida.app.instruments.objects.editing import with_scene
from lucida.app.window import taking
from lucida.app.window.scene_saving import title
from lucida.renderer.editing.changing import set_field
from lucida.renderer.editing.documents import is_unsaved
from lucida.renderer.files import load_scene

# Saving.


def drive_a_changed_scene_is_saved_with_its_comments(d):
    enter(d)
    window, path = d.window, opened(d)
    assert "*" not in title(window.state.scene)
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.75)
    window.change(with_scene(window.state, scene))
    d.frames(3)
    assert "*" in title(window.state.scene)
    d.press(CTRL | Key.s)
    d.until(lambda: not is_unsaved(window.state.scene))
    assert "*" not in title(window.state.scene)
    text = path.read_text()
    for line in SCENE.splitlines():
        assert line in text
    assert "radius = 0.75" in text
    d.until(lambda: any("kept.toml" in said for said in window.shell.toasts.texts))
    window.undo()  # not what is in the file
    d.frames(3)
    assert is_unsaved(window.state.scene)
    window.redo()
    d.frames(3)
    assert not is_unsaved(window.state.scene)
    window.shell.toasts.clear()


def drive_a_file_that_another_has_changed_is_asked_about(d):
    enter(d)
    window, path = d.window, opened(d, name="theirs")
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.5)
    window.files.follow = lambda scene: False  # else it is read again, before anybody can save
    try:
        window.change(with_scene(window.state, scene))
        path.write_text(SCENE + "\n# theirs\n")
        for answer, kept in (("Cancel", True), ("Overwrite it", False)):
            d.press(CTRL | Key.s)
            d.until(lambda: window.files.question is not None)
            d.frames(3)
            assert "# theirs" in path.read_text()
            d.click(f"//##message/{answer}")
            if kept:
                assert is_unsaved(window.state.scene)
        d.until(lambda: not is_unsaved(window.state.scene))
        assert "radius = 0.5" in path.read_text()
    finally:
        del window.files.follow
    window.shell.toasts.clear()


def drive_closing_asks_about_what_is_not_saved(d):
    enter(d)
    window, path = d.window, opened(d, name="closing")
    ended = []
    window.saving.end = lambda: ended.append("quit")
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.25)
    window.change(with_scene(window.state, scene))
    d.press(CTRL | Key.q)
    assert window.files.question is not None
    assert not ended
    d.click("//##message/Cancel")
    assert window.files.question is None
    assert not ended
    d.press(CTRL | Key.q)
    d.click("//##message/Quit without saving")
    assert ended == ["quit"]
    assert "radius" not in path.read_text()
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.3)
    window.change(with_scene(window.state, scene))
    d.press(CTRL | Key.q)
    d.click("//##message/Save")
    d.until(lambda: len(ended) == 2)
    assert "radius = 0.3" in path.read_text()
    window.shell.toasts.clear()
    assert load_scene(path).objects


def drive_a_dropped_model_is_added_once_the_user_has_said_so(d):
    window = d.window
    path = d.folder / "wedge.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n", "utf-8")
    before = len(window.state.scene.objects)
    d.drop([str(path)])
    d.until(lambda: window.files.question is not None)
    d.frames(2)
    d.click(f"//##message/{taking.ADD}")
    d.until(lambda: len(window.state.scene.objects) == before + 1)
    assert chosen(window.state)
    d.settle()
    window.undo()
    assert len(window.state.scene.objects) == before
    d.drop([str(path)])
    d.until(lambda: window.files.question is not None)
    d.frames(2)
    d.click(f"//##message/{taking.OPEN}")
    d.until(lambda: window.state.scene.name == "wedge")
