"""Sets of cameras and their photographs: opened, listed, walked, pointed at, framed, left."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from imgui_bundle import hello_imgui, imgui
from option_changes import with_options
from outside_window import place, scope, strokes
from outside_window import view as outside_view
from PIL import Image
from window_driver import RASTER, Driver, Key, changed

from lucida.app.instruments.poses.model import PoseSet, frusta
from lucida.app.instruments.poses.photographs import photo_path
from lucida.app.instruments.poses.view import POSES, PosesView
from lucida.app.state.options.photograph import PhotographOptions
from lucida.app.state.paths import restored
from lucida.app.ui import layout
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import PosedCamera, written

WINDOW = f"//###{POSES}"
COUNT = 12
DOWN, UP, HOME, END = (int(key) for key in (Key.down_arrow, Key.up_arrow, Key.home, Key.end))


def view(d: Driver) -> PosesView:
    return d.window.view(PosesView)


def ring(count: int, reach: float = 5.0) -> list[PosedCamera]:
    posed = []
    for k in range(count):
        angle = 2 * np.pi * k / count
        eye = (reach * np.cos(angle), 0.5 * reach, reach * np.sin(angle))
        camera = Camera.look_at(eye, (0, 0.5, 0), fov_y_deg=45.0, aspect=4 / 3)
        posed.append(PosedCamera(camera, (80, 60), f"{k:03}.png"))
    return posed


def transforms(d: Driver, count: int = COUNT) -> Path:
    """With photographs of all but the last one."""
    folder = d.folder / f"set{count}"
    (folder / "images").mkdir(parents=True, exist_ok=True)
    table = json.loads(written(ring(count), "nerf")[""])
    for k, frame in enumerate(table["frames"]):
        frame["file_path"] = f"./images/{k:03}.png"
        if k < min(count, COUNT) - 1:
            Image.new("RGB", (80, 60), (20 * k, 90, 160)).save(folder / "images" / f"{k:03}.png")
    path = folder / "transforms.json"
    path.write_text(json.dumps(table))
    return path


def colmap(d: Driver, points: int) -> Path:
    folder = d.folder / f"model{points}" / "sparse" / "0"
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in written(ring(COUNT), "colmap").items():
        (folder / name).write_bytes(data)
    places = np.random.default_rng(1).uniform(-1, 1, (points, 3))
    lines = [f"{k} {x} {y} {z} 250 20 250 0.1 1 2\n" for k, (x, y, z) in enumerate(places)]
    (folder / "points3D.txt").write_text("".join(lines))
    return folder


def opened(d: Driver, path: Path) -> PoseSet:
    d.drop([str(path)])
    d.until(lambda: restored(d.window.state.options.poses.file) == str(path))
    d.until(lambda: POSES in d.window.shell.stage.rects and view(d).poses is not None)
    d.until(lambda: view(d).poses.path == path)
    d.settle()
    found = view(d).poses
    assert found is not None
    return found


def leave(d: Driver) -> None:
    d.window.shell.stage.show(POSES, False)
    d.ctx.yield_(3)
    hello_imgui.switch_layout(layout.LAYOUTS[0].name)
    d.ctx.yield_(5)


def chosen(d: Driver) -> int:
    return d.window.state.options.poses.pose


def stands_at(d: Driver, poses: PoseSet, number: int) -> bool:
    return d.window.state.view == poses.view(number)


def drive_a_set_is_dropped_closed_and_hidden(d: Driver) -> None:
    stage, outside = d.window.shell.stage, outside_view(d)
    stage.show_in(POSES, layout.OUTSIDE)
    d.until(lambda: POSES in stage.rects)
    d.ctx.yield_(5)
    d.ctx.item_click(f"{WINDOW}/Open cameras...")
    d.ctx.yield_(3)
    dialog = d.window.files.dialog
    assert dialog.is_open and ".json" in dialog.question.endings
    dialog.cancel()
    poses = opened(d, transforms(d))
    # In a world of its own, seen by its first camera.
    assert chosen(d) == 0 and stands_at(d, poses, 0) and not d.window.state.scene.objects
    d.window.undo()
    assert d.window.state.scene is d.start.scene and view(d).chosen(d.window.state) == -1
    d.window.redo()
    d.until(lambda: view(d).poses is poses)
    d.settle()
    assert outside.extensions.cloud is not None and outside.extensions.lines
    shown = d.picture()
    # Each frustum is visible: without the set, something else is where its lines are.
    d.ctx.item_click(f"{WINDOW}/###close")
    d.until(lambda: outside.extensions.cloud is None)
    d.settle()
    bare = d.picture()
    left, top, right, bottom = (round(edge) for edge in stage.rects["Outside"])
    cut = (slice(top, bottom), slice(left, right))
    assert changed(bare[cut].astype(int), shown[cut].astype(int)) > 0.005
    assert view(d).poses is None and d.window.state.options.poses.file == ""
    d.window.undo()
    # At once: the set is kept.
    d.until(lambda: view(d).poses is poses and outside.extensions.cloud is not None)
    stage.show(POSES, False)
    d.until(lambda: outside.extensions.cloud is None)
    assert not outside.extensions.lines and outside.extensions.cloud is None
    stage.show(POSES)
    d.until(lambda: outside.extensions.cloud is not None)
    leave(d)


def drive_cameras_are_taken_by_click_key_and_double_click(d: Driver) -> None:
    poses = opened(d, transforms(d))
    d.window.change(with_options(d.window.state, outside={"image": False, "grid": False}))
    d.settle()
    before, steps = d.window.state, len(d.window.history.past)
    d.ctx.item_click(f"{WINDOW}/**/###3")
    d.settle()
    assert chosen(d) == 3 and stands_at(d, poses, 3)
    assert len(d.window.history.past) == steps + 1
    (lines,) = strokes(d, "other pose")[:1]
    assert len(lines.points)
    d.window.undo()
    d.ctx.yield_(2)
    assert d.window.state.view == before.view and chosen(d) == 0
    d.window.redo()
    d.ctx.yield_(2)
    assert chosen(d) == 3 and stands_at(d, poses, 3)
    for key, wanted in ((DOWN, 4), (DOWN, 5), (UP, 4), (END, COUNT - 1), (DOWN, COUNT - 1),
                        (HOME, 0), (UP, 0)):  # fmt: skip
        d.press(key)
        assert chosen(d) == wanted and stands_at(d, poses, wanted), (key, wanted)
    at = scope(d)
    d.ctx.mouse_teleport_to_pos((at.origin.x + 12, at.origin.y + 0.5 * at.extent.y))
    d.ctx.yield_(2)
    d.ctx.mouse_click(0)
    d.ctx.yield_(3)
    for key, wanted in ((int(Key.right_arrow), 1), (DOWN, 2), (int(Key.left_arrow), 1), (END, 11)):
        d.press(key)
        assert chosen(d) == wanted and stands_at(d, poses, wanted), (key, wanted)
    # Where the mouse rests on an image, they move the mark.
    d.window.change(with_options(d.window.state, marked=(5, 5)))
    d.ctx.mouse_teleport_to_pos(d.point(RASTER, 0.5, 0.5))
    d.ctx.yield_(2)
    d.press(DOWN)
    assert d.window.state.marked == (6, 5) and chosen(d) == 11
    frames = frusta(poses, poses.length).reshape(COUNT, -1, 2, 3)
    for number in (2, 7):
        spot = frames[number, 1].mean(axis=0)  # of an edge
        d.ctx.mouse_teleport_to_pos(place(d, spot))
        d.ctx.yield_(3)
        assert view(d).hovered == number
        assert strokes(d, "mark pose")
        d.ctx.mouse_double_click(imgui.MouseButton_.left)
        d.ctx.yield_(3)
        assert chosen(d) == number and stands_at(d, poses, number)
        assert not d.window.state.options.objects.chosen  # of what lies behind it
        d.settle()
    d.ctx.mouse_teleport_to_pos((3, 700))
    d.ctx.yield_(3)
    assert view(d).hovered is None and not strokes(d, "mark pose")
    leave(d)


def drive_a_passage_is_one_step_with_the_choice(d: Driver) -> None:
    poses = opened(d, transforms(d))
    steps = len(d.window.history.past)
    start = d.window.state
    transition = d.window.motions.transition
    transition.instant, clock = False, transition.now_s
    time_s = 100.0
    transition.now_s = lambda: time_s
    try:
        view(d).take(d.window, 5)
        d.ctx.yield_(2)
        assert chosen(d) == 5 and d.window.state.view == start.view
        time_s += 0.2
        d.ctx.yield_(2)
        assert not stands_at(d, poses, 5) and d.window.state.view != start.view
        view(d).take(d.window, 6)  # before it is there: at once, and the first is a step of its own
        d.ctx.yield_(2)
        assert chosen(d) == 6 and stands_at(d, poses, 6)
        assert len(d.window.history.past) == steps + 2
        d.window.undo()
        d.ctx.yield_(2)
        assert chosen(d) == 5 and stands_at(d, poses, 5)
        d.window.undo()
        d.ctx.yield_(2)
        assert d.window.state == start
        view(d).take(d.window, 4)
        d.ctx.yield_(2)
        time_s += 10.0
        d.ctx.yield_(3)
        assert chosen(d) == 4 and stands_at(d, poses, 4)
        assert len(d.window.history.past) == steps + 1
    finally:
        transition.now_s, transition.instant = clock, True
    leave(d)


def drive_points_are_framed_drawn_and_left_out(d: Driver) -> None:
    poses, outside = opened(d, colmap(d, 3000)), outside_view(d)
    assert len(poses.points) == 3000
    before = d.window.state.options.outside.camera
    d.ctx.item_click(f"{WINDOW}/###frame")
    d.ctx.mouse_teleport_to_pos((3, 700))
    d.settle()
    camera = d.window.state.options.outside.camera
    assert camera is not None and camera != before
    at = scope(d)
    for eye in poses.origins.mean(axis=1):
        x, y = place(d, eye)
        assert at.origin.x < x < at.origin.x + at.extent.x
        assert at.origin.y < y < at.origin.y + at.extent.y

    def magenta() -> int:
        shown = d.picture().astype(int)
        left, top, right, bottom = (round(e) for e in d.window.shell.stage.rects["Outside"])
        cut = shown[top:bottom, left:right]
        return int(((cut[..., 0] > 150) & (cut[..., 1] < 60) & (cut[..., 2] > 150)).sum())

    assert magenta() > 1000
    drawn = outside.primitives
    d.ctx.yield_(20)  # nothing is drawn anew while nothing changes
    assert outside.primitives is drawn
    view(d).take(d.window, 1)
    d.settle()
    assert outside.primitives is not drawn
    d.window.undo()
    d.ctx.item_click(f"{WINDOW}/points")
    d.ctx.mouse_teleport_to_pos((3, 700))
    d.settle()
    assert magenta() < 100 and not d.window.state.options.poses.points
    d.window.undo()
    d.settle()
    assert magenta() > 1000
    d.window.undo()
    assert d.window.state.options.outside.camera == before
    leave(d)


def drive_the_photograph_follows_the_set(d: Driver) -> None:
    poses = opened(d, transforms(d))

    def file() -> PhotographOptions:
        return d.window.state.options.photograph

    def take(number: int) -> None:
        view(d).take(d.window, number)
        d.settle()

    take(0)
    d.ctx.item_click(f"//###{POSES}/**/on the images")
    d.settle()
    assert restored(file().file) == str(photo_path(poses, 0)) and file().follows
    take(1)
    assert restored(file().file) == str(photo_path(poses, 1))
    toasts = d.window.shell.toasts
    toasts.clear()
    take(COUNT - 1)  # its file is not there
    assert f"{COUNT - 1:03}.png: does not exist" in toasts.texts[0]
    d.window.undo()
    d.settle()
    assert restored(file().file) == str(photo_path(poses, 1))
    view(d).lay(d.window, poses)
    assert file().file == "" and not file().follows
    leave(d)


def drive_a_mistake_is_reported_and_a_set_follows_its_file(d: Driver) -> None:
    path = transforms(d)
    poses = opened(d, path)
    away, broken = d.folder / "away.json", d.folder / "broken.json"
    d.window.change(with_options(d.window.state, poses={"file": str(away), "pose": -1}))
    d.until(lambda: view(d).poses is None and str(away) in view(d).problem)
    assert outside_view(d).extensions.cloud is None
    d.window.undo()
    d.until(lambda: view(d).poses is poses)
    broken.write_text("{")
    d.drop([str(broken)])
    d.until(lambda: "line 1, column 2" in d.window.files.message)
    assert view(d).poses is poses  # the old one stays
    d.window.files.message = ""
    view(d).take(d.window, 2)
    table = json.loads(path.read_text())
    table["frames"] = table["frames"][1:]
    path.write_text("{")
    d.until(lambda: "line 1, column 2" in d.window.files.message)
    assert view(d).poses is not None and chosen(d) == 2
    path.write_text(json.dumps(table))
    d.until(lambda: view(d).poses is not None and len(view(d).poses.names) == COUNT - 1)
    d.until(lambda: chosen(d) == 1 and not d.window.files.message)  # the same camera, by its name
    leave(d)


def drive_a_lecture_shows_a_set(d: Driver) -> None:
    transforms(d)
    path = d.folder / "poses.toml"
    path.write_text(
        'title = "Poses"\n[[steps]]\ntitle = "a set"\nviews = ["poses", "outside"]\n'
        f'options.poses.file = "set{COUNT}/transforms.json"\noptions.poses.pose = 2\n'
    )
    d.window.files.open_lecture(str(path))
    d.until(lambda: chosen(d) == 2)
    d.until(lambda: POSES in d.window.shell.stage.rects and view(d).poses is not None)
    d.settle()
    d.window.lecture.leave(d.window)
    d.ctx.yield_(5)
    d.settle()
