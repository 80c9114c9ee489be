"""A set of cameras from the command line, and from one start of the window to the next."""

import json

import numpy as np
from format_cameras import transforms_json
from launching import launch
from PIL import Image
from test_window import drives_take_long

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import PosedCamera

SCRIPT = """
import sys
from pathlib import Path
from lucida.app.instruments.poses.reading import open_cameras
from lucida.app.instruments.poses.view import POSES
from lucida.app.state.paths import stored
from stepped import session_window, stepped

folder, mode = Path(sys.argv[1]), sys.argv[2]
if mode == "named":
    poses = open_cameras(str(folder / "transforms.json"))
    run = session_window(folder, {"poses": {"file": stored(str(poses.path))}}, poses=poses)
else:
    run = session_window(folder)
view, frames = run.window.views[POSES], []

def step():
    frames.append(1)
    if view.poses is not None and POSES in run.window.shell.stage.rects and run.window.settled:
        if mode == "named" and run.window.state.options.poses.pose < 0:
            run.window.motions.transition.instant = True
            view.take(run.window, 2)
            return
        same = run.window.state.view == view.poses.view(2)
        print(len(view.poses.names), run.window.state.options.poses.pose, same)
        run.params.app_shall_exit = True

stepped(run, step)
"""


def transforms(folder):
    posed = [
        PosedCamera(Camera.look_at((x, 2.0, 6.0), (0, 0.5, 0), aspect=4 / 3), (80, 60), f"{x}.png")
        for x in (-2.0, 0.0, 1.0, 3.0)
    ]
    path = folder / "transforms.json"
    path.write_text(transforms_json(posed))
    assert len(json.loads(path.read_text())["frames"]) == 4
    return path


@drives_take_long
def test_the_next_start_goes_on_with_the_set_and_the_chosen_one(tmp_path):
    transforms(tmp_path)
    for mode in ("named", "again"):
        done = launch(["-c", SCRIPT, str(tmp_path), mode], tmp_path)
        assert done.returncode == 0, done.stderr
        assert done.stdout.split() == ["4", "2", "True"]


def test_the_command_line_opens_a_set_and_draws_it(tmp_path):
    transforms(tmp_path)
    pictures = []
    for source in ("transforms.json", "still-life"):
        picture = tmp_path / f"{len(pictures)}.png"
        arguments = ["--screenshot", str(picture), "--size", "640x400"]
        done = launch(["-m", "lucida", source, *arguments], tmp_path)
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
        pictures.append(np.asarray(Image.open(picture).convert("RGB")).astype(int))
    differ = np.abs(pictures[0] - pictures[1]).max(axis=2) > 8
    assert differ.mean() > 0.2  # another layout, with the outside view and the list
