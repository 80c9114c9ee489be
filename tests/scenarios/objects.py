"""The scene in hand: choosing, the list, the inspector, handles, and saving what was changed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from imgui_bundle import hello_imgui, imgui
from outside_window import place
from window_driver import RASTER, RAY, Driver, Key

from app.objects.choosing import choose, chosen, rows_of
from app.objects.editing import with_scene
from app.objects.handles import LENGTH, frame_of
from app.objects.options import ObjectsOptions
from app.outside.view import OUTSIDE
from app.window import dropping
from app.window.title import title
from renderer.scene import load_scene
from renderer.scene.model import Sphere
from renderer.scene_editing import objects
from renderer.scene_editing.changing import fields_of, ids_of, set_field
from renderer.scene_editing.documents import is_unsaved
from renderer.scene_editing.materials import material_of
from renderer.scene_editing.moving import bounds_of

CTRL, SHIFT = int(Key.mod_ctrl), int(Key.mod_shift)
SCENE = """# A ball that is kept as it is written.
name = "kept"

[[objects]]
type = "sphere"   # round
name = "ball"
center = [0, 1, 0]

[[objects]]
type = "box"
name = "chest"
translate = [2.5, 0.5, 0]
"""


def enter(d: Driver) -> None:
    if hello_imgui.current_layout_name() != "Scene":
        hello_imgui.switch_layout("Scene")
        d.ctx.yield_(5)
    d.window.change(
        d.window.state.with_options(objects={"chosen": (), "selects": False, "handle": "none"})
    )
    d.settle()


def item(d: Driver, name: str) -> int:
    """The key of what is called so."""
    found = next(row for row in rows_of(d.window.state.scene) if row.shown == name)
    assert found.item is not None
    return found.item


def now(d: Driver) -> tuple[str, ...]:
    """What is chosen, by name."""
    names = {row.item: row.shown for row in rows_of(d.window.state.scene)}
    return tuple(names[key] for key in chosen(d.window.state))


def ball(d: Driver, name: str) -> Sphere:
    (number,) = ids_of(d.window.state.scene, item(d, name))
    shape = d.window.state.scene.objects[number].shape
    assert isinstance(shape, Sphere)
    return shape


def in_image(d: Driver, name: str, point: np.ndarray) -> tuple[float, float]:
    """Where a world point is in an image on the screen."""
    window = d.window
    seen = window.renderers.camera(window.state).project(point, (1, 1))
    return d.point(name, float(seen.column) + 0.5, float(seen.row) + 0.5)


def seen_at(d: Driver, view: str, name: str) -> tuple[float, float]:
    """A pixel at which an object is to be seen in a view, far from its border."""
    center = np.asarray(ball(d, name).center)
    return place(d, center) if view == OUTSIDE else in_image(d, view, center)


def click(d: Driver, at: tuple[float, float], double: bool = False) -> None:
    d.ctx.mouse_teleport_to_pos(at)
    d.ctx.yield_(2)
    if double:
        d.ctx.mouse_double_click(0)
    else:
        d.ctx.mouse_click(0)
    d.ctx.yield_(3)


@contextmanager
def held(d: Driver, key: Key) -> Iterator[None]:
    d.ctx.key_down(key)
    d.ctx.yield_()
    yield
    d.ctx.key_up(key)
    d.ctx.yield_()


def in_list(d: Driver, name: str, part: str = "##row") -> str:
    return f"//###Objects/**/{item(d, name)}/{part}"


def opened(d: Driver, text: str = SCENE, name: str = "kept") -> Path:
    path = d.folder / f"{name}.toml"
    path.write_text(text)
    d.window.open(str(path))
    d.until(lambda: d.window.state.scene.name == "kept")
    d.settle()
    return path


# Choosing.


def drive_a_double_click_chooses_in_every_view(d: Driver) -> None:
    enter(d)
    for view in (RASTER, RAY, OUTSIDE):
        click(d, seen_at(d, view, "shiny sphere"), double=True)
        assert now(d) == ("shiny sphere",), view
        d.press(int(Key.escape))
        assert now(d) == (), view
    assert d.window.state.marked is None  # as two clicks leave it
    assert not d.window.history.present.of(ObjectsOptions).chosen


def drive_clicks_mark_pixels_unless_they_are_to_choose(d: Driver) -> None:
    enter(d)
    window = d.window
    click(d, seen_at(d, RASTER, "matte sphere"))
    assert window.state.marked is not None
    assert now(d) == ()
    window.change(window.state.with_options(marked=None))
    d.press(int(Key.v))
    assert window.state.of(ObjectsOptions).selects
    for view in (RASTER, RAY, OUTSIDE):
        click(d, seen_at(d, view, "matte sphere"))
        assert now(d) == ("matte sphere",), view
        with held(d, Key.mod_shift):
            click(d, seen_at(d, view, "shiny sphere"))
        assert now(d) == ("matte sphere", "shiny sphere"), view
        with held(d, Key.mod_shift):
            click(d, seen_at(d, view, "matte sphere"))
        assert now(d) == ("shiny sphere",), view
        assert window.state.marked is None
        d.press(int(Key.escape))
    d.picture()


def drive_tab_walks_where_the_mouse_is(d: Driver) -> None:
    enter(d)
    click(d, seen_at(d, RASTER, "matte sphere"), double=True)
    names = [row.shown for row in rows_of(d.window.state.scene)]
    at = names.index("matte sphere")
    for step, chord in ((1, int(Key.tab)), (-1, SHIFT | int(Key.tab)), (-1, SHIFT | int(Key.tab))):
        at += step
        d.press(chord)
        assert now(d) == (names[at],)
    d.press(int(Key.escape))
    assert now(d) == ()


# The list.


def drive_rows_are_chosen_as_everywhere(d: Driver) -> None:
    enter(d)
    names = [row.shown for row in rows_of(d.window.state.scene)]
    d.ctx.item_click(in_list(d, names[1]))
    assert now(d) == (names[1],)
    with held(d, Key.mod_ctrl):
        d.ctx.item_click(in_list(d, names[3]))
    assert now(d) == (names[1], names[3])
    with held(d, Key.mod_shift):
        d.ctx.item_click(in_list(d, names[4]))
    assert now(d) == (names[3], names[4])
    d.picture()
    d.ctx.key_press(CTRL | int(Key.a))
    d.ctx.yield_(3)
    assert now(d) == tuple(names)
    d.press(int(Key.escape))


def drive_a_name_is_typed_in_its_row(d: Driver) -> None:
    enter(d)
    key = item(d, "box")
    d.ctx.item_double_click(in_list(d, "box"))
    d.ctx.yield_(3)
    d.ctx.key_chars_replace("crate")
    d.press(int(Key.escape))
    assert item(d, "box") == key
    d.ctx.item_double_click(in_list(d, "box"))
    d.ctx.yield_(3)
    d.ctx.key_chars_replace_enter("crate")
    d.ctx.yield_(3)
    assert item(d, "crate") == key
    d.window.undo()
    assert item(d, "box") == key


def drive_what_is_typed_edits_no_object(d: Driver) -> None:
    """Delete, Ctrl+A, C, V and D are the text's while a field has the keyboard."""
    enter(d)
    d.ctx.item_click(in_list(d, "box"))
    before = d.window.state.scene
    d.ctx.item_click("//###Objects/##search")
    d.ctx.key_chars("box")
    for chord in (CTRL | int(Key.a), CTRL | int(Key.c), CTRL | int(Key.v), CTRL | int(Key.d)):
        d.press(chord)
    d.press(int(Key.delete))
    d.press(CTRL | int(Key.a))
    d.press(int(Key.delete))
    assert d.window.state.scene is before
    assert now(d) == ("box",)
    d.press(int(Key.escape))


def drive_the_search_leaves_what_matches(d: Driver) -> None:
    enter(d)
    d.ctx.item_click("//###Objects/##search")
    d.ctx.key_chars("torus")
    d.ctx.yield_(3)
    assert d.ctx.item_exists(in_list(d, "torus"))
    assert d.ctx.item_exists(in_list(d, "sphere in the torus"))
    assert not d.ctx.item_exists(in_list(d, "box"))
    d.picture()
    d.press(CTRL | int(Key.a))
    d.press(int(Key.delete))
    d.press(int(Key.escape))
    d.ctx.yield_(3)
    assert d.ctx.item_exists(in_list(d, "box"))


def drive_the_eye_hides_from_both_images(d: Driver) -> None:
    enter(d)
    before = d.agreeing_images()
    d.ctx.item_click(in_list(d, "matte sphere", "eye"))
    d.ctx.yield_(3)
    assert next(r for r in rows_of(d.window.state.scene) if r.shown == "matte sphere").hidden
    after = d.agreeing_images()
    assert all(
        (np.abs(a - b).max(axis=2) > 8).mean() > 0.01 for a, b in zip(before, after, strict=True)
    )
    d.window.undo()
    d.settle()


def drive_what_is_locked_is_left_alone(d: Driver) -> None:
    enter(d)
    window = d.window
    d.ctx.item_click(in_list(d, "matte sphere", "lock"))
    d.ctx.yield_(3)
    scene = window.state.scene
    click(d, seen_at(d, RASTER, "matte sphere"), double=True)
    assert now(d) == ()
    d.ctx.item_click(in_list(d, "matte sphere"))  # in the list it can be chosen
    assert now(d) == ("matte sphere",)
    window.change(window.state.with_options(objects={"handle": "move"}))
    _drag_handle(d, RASTER, "matte sphere", 1)
    d.press(int(Key.delete))
    assert window.state.scene is scene
    window.undo()
    d.settle()


def drive_rows_are_dragged_into_another_order(d: Driver) -> None:
    enter(d)
    names = [row.shown for row in rows_of(d.window.state.scene)]
    d.ctx.item_drag_and_drop(in_list(d, names[3]), in_list(d, names[1]))
    d.ctx.yield_(3)
    after = [row.shown for row in rows_of(d.window.state.scene)]
    assert after == [names[0], names[3], *names[1:3], *names[4:]]
    d.agreeing_images()
    d.window.undo()
    assert [row.shown for row in rows_of(d.window.state.scene)] == names


# The inspector.


def drive_a_number_that_is_dragged_is_one_step(d: Driver) -> None:
    enter(d)
    window = d.window
    d.ctx.item_click(in_list(d, "matte sphere"))
    d.ctx.yield_(3)
    steps, radius = len(window.history.past), ball(d, "matte sphere").radius
    middle = d.ctx.item_info("//###Inspector/##radius").rect_full.get_center()
    d.drag((middle.x, middle.y), (middle.x + 30, middle.y))
    d.ctx.yield_(3)
    assert ball(d, "matte sphere").radius != radius
    assert len(window.history.past) == steps + 1
    d.agreeing_images()
    window.undo()
    assert ball(d, "matte sphere").radius == radius
    assert now(d) == ("matte sphere",)


def drive_a_material_is_changed_for_all_or_for_one(d: Driver) -> None:
    enter(d)
    window = d.window
    row = next(
        row
        for row in rows_of(window.state.scene)
        if row.material and len(material_of(window.state.scene, row.item).users) > 1
    )
    users = material_of(window.state.scene, row.item).users
    count = len(users)
    d.ctx.item_click(in_list(d, row.shown))
    d.ctx.yield_(3)
    d.picture()
    d.ctx.item_double_click("//###Inspector/##shininess")
    d.ctx.key_chars_replace_enter("7")
    d.ctx.yield_(3)
    assert {material_of(window.state.scene, key).material.shininess for key in users} == {7.0}
    d.ctx.item_click(f"//###Inspector/for all {count} that have it")
    d.ctx.item_double_click("//###Inspector/##shininess")
    d.ctx.key_chars_replace_enter("9")
    d.ctx.yield_(3)
    shine = [material_of(window.state.scene, key).material.shininess for key in users]
    assert sorted(shine) == [7.0] * (count - 1) + [9.0]
    d.ctx.item_click("//###Inspector/checker")
    d.ctx.yield_(3)
    assert material_of(window.state.scene, row.item).material.checker is not None
    d.agreeing_images()


def drive_nothing_chosen_shows_the_scene_s_own(d: Driver) -> None:
    enter(d)
    before = d.window.state.scene.background
    d.ctx.item_double_click("//###Inspector/##sky/##X")
    d.ctx.key_chars_replace_enter("200")
    d.ctx.yield_(3)
    after = d.window.state.scene.background
    assert after[0] > before[0]
    assert after[1:] == before[1:]
    d.agreeing_images()


# Adding, copying, deleting.


def drive_every_shape_and_light_is_added_and_both_images_agree(d: Driver) -> None:
    enter(d)
    window = d.window
    for kind in (*objects.SHAPES, *objects.LIGHTS):
        light = kind in objects.LIGHTS
        name = f"Add {kind} light" if light else f"Add {kind}"
        before = {row.item for row in rows_of(window.state.scene)}
        d.ctx.menu_click(f"//##MainMenuBar/Scene/Add/{name}")
        d.ctx.yield_(3)
        (new,) = {row.item for row in rows_of(window.state.scene)} - before
        assert chosen(window.state) == (new,)
    d.agreeing_images()
    assert len(rows_of(window.state.scene)) == len(rows_of(d.start.scene)) + len(
        (*objects.SHAPES, *objects.LIGHTS)
    )


def drive_the_chosen_are_copied_pasted_and_deleted(d: Driver) -> None:
    enter(d)
    window = d.window
    count = len(rows_of(window.state.scene))
    window.amend(choose(window.state, (item(d, "shiny sphere"),)))
    d.ctx.yield_(2)
    d.press(CTRL | int(Key.d))
    assert len(rows_of(window.state.scene)) == count + 1
    d.press(CTRL | int(Key.c))
    assert "[[objects]]" in imgui.get_clipboard_text()
    d.press(CTRL | int(Key.v))
    assert len(rows_of(window.state.scene)) == count + 2
    assert len(chosen(window.state)) == 1
    d.press(int(Key.delete))
    assert len(rows_of(window.state.scene)) == count + 1
    assert now(d) == ()
    d.agreeing_images()
    window.undo()
    window.undo()
    window.undo()
    assert len(rows_of(window.state.scene)) == count
    window.shell.toasts.clear()


# Handles.


def _drag_handle(d: Driver, view: str, name: str, axis: int) -> None:
    """The arrow of an axis, dragged by its middle."""
    window = d.window
    focus = window.focus
    frame = frame_of(window.state.scene, (item(d, name),), focus.center)
    spot = frame[:3, 3]
    step = np.eye(3)[axis] * 0.05 * focus.reach

    def on_screen(point: np.ndarray) -> np.ndarray:
        at = place(d, point) if view == OUTSIDE else in_image(d, view, point)
        return np.asarray(at)

    start = on_screen(spot)
    way = on_screen(spot + step) - start
    way = way / np.linalg.norm(way)
    left, _, right, _ = d.rect(view) if view != OUTSIDE else (0.0, 0.0, _outside_width(d), 0.0)
    grip = start + 0.3 * LENGTH * (right - left) * way
    d.ctx.mouse_teleport_to_pos(tuple(grip))
    d.ctx.yield_(4)
    d.drag(tuple(grip), tuple(grip + 25 * way))
    d.ctx.yield_(3)


def _outside_width(d: Driver) -> float:
    box = d.ctx.item_info(f"//###{OUTSIDE}/image##{OUTSIDE}").rect_full
    return box.max.x - box.min.x


def drive_handles_move_in_the_images_and_outside(d: Driver) -> None:
    enter(d)
    window = d.window
    window.change(window.state.with_options(objects={"handle": "move"}))
    for view in (RASTER, OUTSIDE):
        window.amend(choose(window.state, (item(d, "shiny sphere"),)))
        d.settle()
        steps, before = len(window.history.past), np.asarray(ball(d, "shiny sphere").center)
        camera = window.state.view, window.state.options.outside.camera
        _drag_handle(d, view, "shiny sphere", 1)
        by = np.asarray(ball(d, "shiny sphere").center) - before
        assert by[1] > 0.02, view
        assert not by[[0, 2]].any()
        assert len(window.history.past) == steps + 1
        assert (window.state.view, window.state.options.outside.camera) == camera
        assert now(d) == ("shiny sphere",)
        d.agreeing_images()
        window.undo()
        assert np.array_equal(ball(d, "shiny sphere").center, before)


def drive_handles_scale_a_sphere_as_a_whole(d: Driver) -> None:
    enter(d)
    window = d.window
    state = window.state.with_options(objects={"handle": "scale"})
    window.change(choose(state, (item(d, "shiny sphere"),)))
    d.settle()
    steps = len(window.history.past)
    start = np.asarray(in_image(d, RASTER, np.asarray(ball(d, "shiny sphere").center)))
    left, _, right, _ = d.rect(RASTER)
    up = np.array([0.0, -1.0])
    for part, way in ((0.15, (1.0, 0.0)), (0.5, up)):  # the ring in the middle; the dot of y
        before = ball(d, "shiny sphere").radius
        for off in np.linspace(0.0, 0.2, 9):
            grip = start + (part + off) * LENGTH * (right - left) * up
            d.ctx.mouse_teleport_to_pos(tuple(grip))
            d.ctx.yield_(3)
            if window.views[RASTER].linked.guest.holds(RASTER):
                d.drag(tuple(grip), tuple(grip + 20 * np.asarray(way)))
                d.ctx.yield_(3)
                break
        assert ball(d, "shiny sphere").radius > before
        assert not window.views[RASTER].linked.guest.handles.problem
    assert len(window.history.past) == steps + 2
    d.agreeing_images()


def drive_handles_turn(d: Driver) -> None:
    enter(d)
    window = d.window
    state = window.state.with_options(objects={"handle": "turn"})
    window.change(choose(state, (item(d, "box"),)))
    d.settle()
    before, steps = fields_of(window.state.scene, item(d, "box")), len(window.history.past)
    middle = bounds_of(window.state.scene, [item(d, "box")]).mean(axis=0)
    start = np.asarray(in_image(d, RASTER, middle))
    left, _, right, _ = d.rect(RASTER)
    radius = 0.5 * LENGTH * (right - left)
    for part in (1.2, 1.0, 0.8):
        for angle in np.linspace(0, 2 * np.pi, 12, endpoint=False):
            grip = start + part * radius * np.array([np.cos(angle), np.sin(angle)])
            d.ctx.mouse_teleport_to_pos(tuple(grip))
            d.ctx.yield_(3)
            if not window.views[RASTER].linked.guest.holds(RASTER):
                continue
            d.drag(tuple(grip), tuple(grip + 25 * np.array([-np.sin(angle), np.cos(angle)])))
            d.ctx.yield_(3)
            after = fields_of(window.state.scene, item(d, "box"))
            assert after.rotate_deg != before.rotate_deg
            assert after.size == before.size
            assert len(window.history.past) == steps + 1
            d.agreeing_images()
            return
    raise AssertionError("no ring was found")


# Saving.


def drive_a_changed_scene_is_saved_with_its_comments(d: Driver) -> None:
    enter(d)
    window, path = d.window, opened(d)
    assert "*" not in title(window.state.scene)
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.75)
    window.change(with_scene(window.state, scene))
    d.ctx.yield_(3)
    assert "*" in title(window.state.scene)
    d.press(CTRL | int(Key.s))
    d.until(lambda: not is_unsaved(window.state.scene))
    assert "*" not in title(window.state.scene)
    text = path.read_text()
    for line in SCENE.splitlines():
        assert line in text
    assert "radius = 0.75" in text
    d.until(lambda: any("kept.toml" in said for said in window.shell.toasts.texts))
    window.undo()  # not what is in the file
    d.ctx.yield_(3)
    assert is_unsaved(window.state.scene)
    window.redo()
    d.ctx.yield_(3)
    assert not is_unsaved(window.state.scene)
    window.shell.toasts.clear()


def drive_a_file_that_another_has_changed_is_asked_about(d: Driver) -> None:
    enter(d)
    window, path = d.window, opened(d, name="theirs")
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.5)
    window.files.follow = lambda scene: False  # else it is read again, before anybody can save
    try:
        window.change(with_scene(window.state, scene))
        path.write_text(SCENE + "\n# theirs\n")
        for answer, kept in (("Cancel", True), ("Overwrite it", False)):
            d.press(CTRL | int(Key.s))
            d.until(lambda: window.files.question is not None)
            d.ctx.yield_(3)
            d.picture()
            assert "# theirs" in path.read_text()
            d.ctx.item_click(f"//##message/{answer}")
            d.ctx.yield_(3)
            if kept:
                assert is_unsaved(window.state.scene)
        d.until(lambda: not is_unsaved(window.state.scene))
        assert "radius = 0.5" in path.read_text()
    finally:
        del window.files.follow
    window.shell.toasts.clear()


def drive_closing_asks_about_what_is_not_saved(d: Driver) -> None:
    enter(d)
    window, path = d.window, opened(d, name="closing")
    ended: list[str] = []
    window.saving.end = lambda: ended.append("quit")
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.25)
    window.change(with_scene(window.state, scene))
    d.press(CTRL | int(Key.q))
    assert window.files.question is not None
    assert not ended
    d.picture()
    d.ctx.item_click("//##message/Cancel")
    d.ctx.yield_(3)
    assert window.files.question is None
    assert not ended
    d.press(CTRL | int(Key.q))
    d.ctx.item_click("//##message/Quit without saving")
    d.ctx.yield_(3)
    assert ended == ["quit"]
    assert "radius" not in path.read_text()
    scene = set_field(window.state.scene, [item(d, "ball")], "radius", 0.3)
    window.change(with_scene(window.state, scene))
    d.press(CTRL | int(Key.q))
    d.ctx.item_click("//##message/Save")
    d.until(lambda: len(ended) == 2)
    assert "radius = 0.3" in path.read_text()
    window.shell.toasts.clear()
    assert load_scene(path).objects


def drive_a_dropped_model_is_added_once_the_user_has_said_so(d: Driver) -> None:
    window = d.window
    path = d.folder / "wedge.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n", "utf-8")
    before = len(window.state.scene.objects)
    d.drop([str(path)])
    d.until(lambda: window.files.question is not None)
    d.ctx.yield_(2)
    d.ctx.item_click(f"//##message/{dropping.ADD}")
    d.until(lambda: len(window.state.scene.objects) == before + 1)
    assert chosen(window.state)
    d.drop([str(path)])  # not asked again
    d.until(lambda: len(window.state.scene.objects) == before + 2)
    assert window.files.question is None
    d.settle()
    d.agreeing_images()
    window.undo()
    window.undo()
    assert len(window.state.scene.objects) == before
    d.ctx.menu_click("//##MainMenuBar/Scene/Dropped models are added")
    d.drop([str(path)])
    d.until(lambda: window.state.scene.name == "wedge")
