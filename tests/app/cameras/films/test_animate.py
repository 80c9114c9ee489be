"""`lucida animate`: films of each kind, breaks, workers that die, and what is refused."""

from __future__ import annotations

import sys
from contextlib import suppress
from itertools import pairwise
from pathlib import Path

import av
import numpy as np
import psutil
import pytest
from PIL import Image

from lucida import Camera, load_scene
from lucida.app.cameras.films import frames, workers
from lucida.app.cameras.films.frames import Look, Shot
from lucida.app.cameras.films.paths import around
from lucida.app.cli import main
from lucida.renderer.scene.focus import scene_focus
from tests.support.refusals import refused

SMALL = ("--size", "32x18", "--renderer", "ray")


@pytest.fixture
def animate(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        status = main(["animate", "spheres", *arguments])
        return status, *capsys.readouterr()

    return run


def pictures(folder):
    return {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}


def test_a_film_and_a_folder_show_the_same_frames(animate):
    assert animate("--orbit", "-o", "out", "--seconds", "0.2", *SMALL)[0] == 0
    assert list(pictures("out")) == [f"{n:06d}.png" for n in range(6)]
    wanted = [np.asarray(Image.open(f"out/{n:06d}.png"), float) for n in range(6)]
    assert all(np.abs(one - two).mean() > 1 for one, two in pairwise(wanted))
    status, out, _ = animate(
        "--orbit", "-o", "o.mp4", "--seconds", "0.2667", "--fps", "22.5", *SMALL
    )
    assert (status, out) == (0, "o.mp4: 6 frames, 32x18, 0.2667 s\n")
    assert not Path("o.mp4.frames").exists()
    with av.open("o.mp4") as container:
        codec = container.streams.video[0].codec_context
        assert (codec.color_primaries, codec.color_trc, codec.colorspace) == (1, 1, 1)
        found = [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]
        assert container.streams.video[0].average_rate == 22.5
    assert len(found) == 6
    for one, two in zip(found, wanted, strict=True):
        assert np.abs(one - two).mean() < 12


def test_the_frames_of_a_folder_are_drawn_once(animate):
    options = ("--orbit", "-o", "v1.5/", "--seconds", "0.1", *SMALL)
    assert animate(*options)[0] == 0
    first = pictures("v1.5")
    Path("v1.5/000001.png").unlink()
    assert animate(*options)[0] == 0
    status, out, _ = animate(*options)
    assert status == 0 and "v1.5: all 3 frames are there" in out
    assert pictures("v1.5") == first


def test_an_interrupted_film_goes_on(animate, monkeypatch):
    drawn = []

    def draw(scene, look, shot):
        if len(drawn) == 3:
            raise KeyboardInterrupt
        drawn.append(shot)
        return frames.draw_shot(scene, look, shot)

    options = ("--orbit", "-o", "o.mp4", "--seconds", "0.1667", *SMALL)
    monkeypatch.setattr(workers, "draw_shot", draw)
    assert animate(*options)[0] == 130
    assert len(pictures("o.mp4.frames")) == 3 and not Path("o.mp4").exists()
    monkeypatch.setattr(workers, "draw_shot", frames.draw_shot)
    broken = Path("o.mp4.frames/000001.png")
    broken.write_bytes(b"")
    status, _, err = animate(*options)
    assert status == 2 and f"{broken}: is not a picture; delete it" in err
    broken.unlink()
    status, out, _ = animate(*options)
    assert status == 0 and "4 of 5 frames are there" in out


def test_workers_draw_the_same_even_if_one_is_killed(tmp_path):
    scene = load_scene("spheres")
    focus = scene_focus(scene)
    look, size = frames.Look("ray", threads=1), (32, 96)
    cameras = around(scene.view, focus, size, 12)
    parts = [(0, 32), (32, 64), (64, 96)]
    shots = [frames.Shot(camera, size, rows) for camera in cameras for rows in (*parts, None)]
    shots = dict(enumerate(shots))
    here = dict(workers.drawn_here(scene, look, shots))
    there, killed = [], False
    for number, png in workers.drawn_by_workers(scene, look, shots, 2):
        there.append((number, png))
        if len(there) >= len(shots) // 2 and not killed:  # a replacement takes long to start
            killed = kill_a_worker()
    assert killed
    assert sorted(number for number, _ in there) == list(shots)  # nothing lost, nothing twice
    assert dict(there) == here


def kill_a_worker():
    for child in psutil.Process().children(recursive=True):
        with suppress(psutil.Error):  # it has ended meanwhile
            if any("spawn_main" in part for part in child.cmdline()):
                child.kill()
                return True
    return False


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--orbit", "-o", "a.gif"), "-o: the ending '.gif' is unknown"),
        (("--orbit", "-o", "a.mp4", "--size", "33x18"), "--size: 33x18 has an odd side"),
        (("--orbit", "-o", "none/a.mp4"), "none"),
        (("--orbit", "-o", "a", "--shadows"), "only image order has it"),
        (("--path", "keys.toml", "-o", "a"), "keys.toml"),
        (("-o", "a.mp4"), "is required"),
    ],
)
def test_mistakes_cost_one_line(animate, capsys, options, message):
    assert message in refused(capsys, "animate", "spheres", *options)


def test_a_scheduler_that_does_not_answer_is_told(animate, monkeypatch):
    monkeypatch.setattr(workers, "PATIENCE_S", 1)
    status, _, err = animate("--orbit", "-o", "a.mp4", "--scheduler", "tcp://127.0.0.1:9")
    assert status == 2 and "does not answer" in err


def test_workers_without_their_package_are_refused_with_the_remedy(animate, monkeypatch):
    monkeypatch.setitem(sys.modules, "dask.distributed", None)
    status, _, err = animate("--orbit", "-o", "a.mp4", "--workers", "2", *SMALL)
    assert status == 2 and "--workers: needs the package distributed; " in err


def test_renderers_are_kept_for_one_scene_and_look(monkeypatch):
    scene, shot, made = load_scene("spheres"), Shot(Camera(eye=(0, 0, 6)), (8, 6)), []
    drawing = frames.Drawing
    monkeypatch.setattr(frames, "Drawing", lambda *of: made.append(of) or drawing(*of))
    looks = Look("ray"), Look("ray"), Look("ray", exposure=1.0)
    one, same, brighter = (frames.draw_shot(scene, look, shot) for look in looks)
    frames.close_kept()
    assert one == same != brighter
    assert made == [(scene, looks[0]), (scene, looks[2])]


def test_what_else_is_in_a_folder_stays(animate):
    Path("a.mp4.frames").mkdir()
    Path("a.mp4.frames/notes.txt").write_text("mine")
    Image.new("RGB", (8, 8)).save("a.mp4.frames/000001.png")
    status, _, err = animate("--orbit", "-o", "a.mp4", "--seconds", "0.0667", *SMALL)
    assert status == 2 and "000001.png: belongs to a film of another size; delete it" in err
    Path("a.mp4.frames/000001.png").unlink()
    assert animate("--orbit", "-o", "a.mp4", "--seconds", "0.0667", *SMALL)[0] == 0
    assert pictures("a.mp4.frames") == {"notes.txt": b"mine"}
