"""Sets of cameras and their photographs: opened, listed, walked, framed, left."""

import json

import numpy as np
from format_cameras import transforms_json
from outside_window import strokes
from outside_window import view as outside_view
from PIL import Image
from window_driver import RASTER, Key, changed

from lucida.app.instruments.poses.photographs import photo_path
from lucida.app.instruments.poses.view import POSES, PosesView
from lucida.app.state.paths import restored
from lucida.app.ui import layout
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import PosedCamera

WINDOW = f"//###{POSES}"
COUNT = 12
DOWN, UP, HOME, END = (key for key in (Key.down_arrow, Key.up_arrow, Key.home, Key.end))


def view(d):
    return d.window.view(PosesView)


def ring(count, reach=5.0):
    posed = []
    for k in range(count):
        angle = 2 * np.pi * k / count
        eye = (reach * np.cos(angle), 0.5 * reach, reach * np.sin(angle))
        camera = Camera.look_at(eye, (0, 0.5, 0), fov_y_deg=45.0, aspect=4 / 3)
        posed.append(PosedCamera(camera, (80, 60), f"{k:03}.png"))
    return posed


def transforms(d, count=COUNT):
    """With photographs of all but the last one."""
    folder = d.folder / f"set{count}"
    (folder / "images").mkdir(parents=True, exist_ok=True)
    table = json.loads(transforms_json(ring(count)))
    for k, frame in enumerate(table["frames"]):
        frame["file_path"] = f"./images/{k:03}.png"
        if k < min(count, COUNT) - 1:
            Image.new("RGB", (80, 60), (20 * k, 90, 160)).save(folder / "images" / f"{k:03}.png")
    path = folder / "transforms.json"
    path.write_text(json.dumps(table))
    return path


def opened(d, path):
    d.drop([str(path)])
    d.until(lambda: restored(d.options.poses.file) == str(path))
    d.until(lambda: POSES in d.stage.rects and view(d).poses is not None)
    d.until(lambda: view(d).poses.path == path)
    d.settle()
    return view(d).poses


def chosen(d):
    return d.options.poses.pose


def stands_at(d, poses, number):
    return d.state.view == poses.view(number)


def drive_a_set_is_dropped_closed_and_hidden(d):
    stage, outside = d.stage, outside_view(d)
    stage.show_in(POSES, layout.OUTSIDE)
    d.until(lambda: POSES in stage.rects)
    d.frames(5)
    d.click(f"{WINDOW}/Open cameras...")
    dialog = d.files.dialog
    assert dialog.is_open and ".json" in dialog.question.endings
    dialog.cancel()
    poses = opened(d, transforms(d))
    # In a world of its own, seen by its first camera.
    assert chosen(d) == 0 and stands_at(d, poses, 0) and not d.state.scene.objects
    d.undo()
    assert d.state.scene is d.start.scene and view(d).chosen(d.state) == -1
    d.window.redo()
    d.until(lambda: view(d).poses is poses)
    d.settle()
    assert outside.extensions.cloud is not None and outside.extensions.lines
    shown = d.picture()
    # Each frustum is visible: without the set, something else is where its lines are.
    d.click(f"{WINDOW}/###close")
    d.until(lambda: outside.extensions.cloud is None)
    d.settle()
    bare = d.picture()
    left, top, right, bottom = (round(edge) for edge in stage.rects["Outside"])
    cut = (slice(top, bottom), slice(left, right))
    assert changed(bare[cut].astype(int), shown[cut].astype(int)) > 0.005
    assert view(d).poses is None and d.options.poses.file == ""
    d.undo()
    # At once: the set is kept.
    d.until(lambda: view(d).poses is poses and outside.extensions.cloud is not None)
    stage.show(POSES, False)
    d.until(lambda: outside.extensions.cloud is None)
    assert not outside.extensions.lines and outside.extensions.cloud is None
    stage.show(POSES)
    d.until(lambda: outside.extensions.cloud is not None)


def drive_cameras_are_taken_by_click_and_key(d):
    poses = opened(d, transforms(d))
    d.change(outside={"image": False, "grid": False})
    d.settle()
    before, steps = d.state, d.steps
    d.click(f"{WINDOW}/**/###3")
    d.settle()
    assert chosen(d) == 3 and stands_at(d, poses, 3)
    width, height = d.renderers.size
    assert abs(width - 4 / 3 * height) < 1, "the photographs' shape"
    assert d.steps == steps + 1
    (lines,) = strokes(d, "other pose")[:1]
    assert len(lines.points)
    d.undo()
    d.frames(2)
    assert d.state.view == before.view and chosen(d) == 0
    d.window.redo()
    d.frames(2)
    assert chosen(d) == 3 and stands_at(d, poses, 3)
    for key, wanted in ((DOWN, 4), (DOWN, 5), (UP, 4), (END, COUNT - 1), (DOWN, COUNT - 1),
                        (HOME, 0), (UP, 0)):  # fmt: skip
        d.press(key)
        assert chosen(d) == wanted and stands_at(d, poses, wanted), (key, wanted)
    # Where the mouse rests on an image, they move the mark.
    d.change(marked=(5, 5))
    d.move_to(d.point(RASTER, 0.5, 0.5))
    d.press(DOWN)
    assert d.state.marked == (6, 5) and chosen(d) == 0


def drive_the_photograph_follows_the_set(d):
    poses = opened(d, transforms(d))

    def file():
        return d.options.photograph

    def take(number):
        view(d).take(d.window, number)

    take(0)
    d.click(f"//###{POSES}/**/on the images")
    d.settle()
    assert restored(file().file) == str(photo_path(poses, 0)) and file().follows
    take(1)
    d.until(lambda: restored(file().file) == str(photo_path(poses, 1)))
    toasts = d.window.shell.toasts
    toasts.clear()
    take(COUNT - 1)  # its file is not there
    d.until(lambda: bool(toasts.texts))
    assert f"{COUNT - 1:03}.png: does not exist" in toasts.texts[0]
    d.undo()
    d.settle()
    assert restored(file().file) == str(photo_path(poses, 1))
    view(d).lay(d.window, poses)
    assert file().file == "" and not file().follows


def drive_a_mistake_is_reported_and_a_set_is_read_when_it_is_opened(d):
    path = transforms(d)
    poses = opened(d, path)
    away, broken = d.folder / "away.json", d.folder / "broken.json"
    d.change(poses={"file": str(away), "pose": -1})
    d.until(lambda: view(d).poses is None and str(away) in view(d).problem)
    assert outside_view(d).extensions.cloud is None
    d.undo()
    d.until(lambda: view(d).poses is poses)
    broken.write_text("{")
    d.drop([str(broken)])
    d.until(lambda: "line 1, column 2" in d.files.message)
    assert view(d).poses is poses  # the old one stays
    d.files.message = ""
    table = json.loads(path.read_text())
    table["frames"] = table["frames"][1:]
    path.write_text(json.dumps(table))
    d.drop([str(path)])  # opened again, it is read again
    d.until(lambda: view(d).poses is not None and len(view(d).poses.names) == COUNT - 1)
