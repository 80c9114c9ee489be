"""`lucida camera`: every option, every mistake; and `--view FILE#NAME` of the other commands."""

from __future__ import annotations

import json
import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from format_cameras import pasted, transforms_json

from lucida import Camera, Lens, View, load_view, save_view
from lucida.app.cli import main
from lucida.app.commands.view import shown_size
from lucida.app.window import launch
from lucida.renderer.files.cameras import PosedCamera
from tests.support.refusals import refused

SIZE = (64, 48)


def nerf(*cameras: PosedCamera) -> None:
    """Write set.json."""
    Path("set.json").write_text(transforms_json(cameras))


def seen(eye: tuple[float, float, float], name: str, size=SIZE, lens: Lens | None = None):
    camera = Camera.look_at(eye, (0, 0, 0), fov_y_deg=40.0, aspect=size[0] / size[1])
    return PosedCamera(replace(camera, lens=lens), size, name)


A, B, C = seen((0, 1, 6), "images/a.jpg"), seen((6, 1, 0), "images/b.jpg"), seen((0, 9, 1), "7")
C = replace(C, size=(32, 48))
BENT = seen((0, 1, 6), "a", lens=Lens("brown", {"k1": -0.2}))


@pytest.fixture(autouse=True)
def in_a_folder_of_cameras(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    nerf(BENT, B)
    Path("set.json").rename("lens.json")
    nerf(A, B, C)
    save_view("corner.toml", View(Camera.look_at((0, 1, 6), (0, 0, 0), fov_y_deg=40.0)))
    save_view("parallel.toml", View(Camera(projection="parallel", near=0.5)))
    save_view("skewed.toml", View(Camera(v=(0.5, 1, 0))))
    Path("text.txt").write_text("no camera")
    Path("folder").mkdir()


def told(capsys, *words: str) -> str:
    """Return the command's output; it must succeed, with nothing on standard error."""
    assert main(["camera", *words]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return out


def facts(capsys, *words: str) -> dict[str, str]:
    lines = [re.split(r"\s{2,}", line, maxsplit=1) for line in told(capsys, *words).splitlines()]
    return {name: text for name, text in lines if name}


class TestDescription:
    def test_one_camera_is_told_whole(self, capsys):
        found = facts(capsys, "set.json#a.jpg")
        assert found["format"].startswith("nerf: NeRF's")
        assert found["taken"].startswith("transform_matrix takes the camera's points")
        assert found["name"] == "images/a.jpg"
        assert found["size"] == "64x48"
        assert found["eye"] == "(0, 1, 6)"
        assert found["distance"] == "1"
        assert found["K"] == "(65.93946, 0, 31.5), (0, 65.93946, 23.5), (0, 0, 1)"
        assert {"distortion", "near"}.isdisjoint(found)

    def test_a_view_file_has_no_pixels_until_it_has_a_size(self, capsys):
        assert facts(capsys, "corner.toml")["size"] == "of any size"
        found = facts(capsys, "corner.toml", "--size", "200x100")
        assert found["K"].startswith("(274.7477, 0, 99.5), (0, 137.3739, 49.5)")


class TestChoice:
    @pytest.mark.parametrize(
        ("words", "name"),
        [
            (["set.json#1"], "images/b.jpg"),
            (["set.json#b.jpg"], "images/b.jpg"),
            (["set.json#images/b.jpg"], "images/b.jpg"),
            (["set.json#7"], "7"),
        ],
    )
    def test_a_camera_is_chosen_by_name_or_number(self, capsys, words, name):
        assert facts(capsys, *words)["name"] == name

    def test_names_with_a_number_sign(self, capsys):
        Path("shot#1").mkdir()
        nerf(A, replace(B, name="b#2"))
        for name in ("set.json#1", "shot#1/h#erd.json"):
            Path(name).write_bytes(Path("set.json").read_bytes())
            assert facts(capsys, name)["cameras"].startswith("2")
            assert facts(capsys, f"{name}#b#2")["name"] == "b#2"
            assert facts(capsys, f"{name}#")["cameras"].startswith("2")


class TestWriting:
    def test_it_is_printed_without_o(self, capsys):
        for which, names in ("", ["images/a.jpg", "images/b.jpg", "7"]), ("#b.jpg", [B.name]):
            data = json.loads(told(capsys, f"set.json{which}", "--to", "gltf"))
            assert [node["name"] for node in data["nodes"]] == names

    def test_the_ending_says_the_format(self, capsys):
        out = told(capsys, "set.json#0", "-o", "a.toml")
        assert out == "a.toml: view, 1 camera\n"
        assert load_view("a.toml").camera.eye == pytest.approx((0, 1, 6))

    def test_the_options_reach_the_format(self, capsys):
        words = ("corner.toml", "--to", "opencv", "--size", "30x20")
        found = pasted(told(capsys, *words, "--pixel-origin", "corner")).cameras[0]
        assert found.size == (30, 20)
        assert found.camera.intrinsics((30, 20), "corner").K[0, 2] == pytest.approx(15)

    def test_a_size_of_another_shape_is_said(self, capsys):
        assert main(["camera", "set.json#0", "--to", "view", "--size", "100x100"]) == 0
        assert capsys.readouterr().err == (
            "lucida: --size: 100x100 has another shape than the camera's own 64x48: "
            "its pixels are not as wide as high\n"
        )
        told(capsys, "set.json#0", "--to", "view", "--size", "640x480")


LENS = "brown, k1 = -0.2"


class TestDistortion:
    def test_a_lens_is_listed_with_its_numbers(self, capsys):
        listed = facts(capsys, "lens.json")
        assert listed["cameras"] == "2: a, images/b.jpg"
        assert listed["lens"] == facts(capsys, "lens.json#0")["lens"] == LENS
        assert json.loads(told(capsys, "lens.json", "--json"))["cameras"][0]["lens"]["k1"] == -0.2

    def test_it_is_taken_off(self, capsys):
        assert "lens" not in facts(capsys, "lens.json", "--no-lens")
        data = json.loads(told(capsys, "lens.json#0", "--no-lens", "--to", "gltf"))
        assert len(data["cameras"]) == 1


MISTAKES = {
    "none.json": "none.json: does not exist",
    "none.json#1#2": "none.json#1: does not exist",
    "text.txt": "text.txt: is not a recognised camera format; export the cameras as glTF or COLMAP",
    "folder": "folder: is a folder without cameras; give the folder of a COLMAP model",
    "": "is a folder without cameras",
    "set.json --to gltff": "--to: 'gltff' is unknown; did you mean 'gltf'?",
    "set.json --to colmap": "--to: 'colmap' is only read; give one of view, opengl, opencv, gltf",
    "set.json --to view -o a.toml": "set.json: holds 3 cameras",
    "set.json -o a.nosuch": "--to: is missing; give one of",
    "set.json#0 -o no/a.toml": "no/a.toml: folder",
    "skewed.toml --to gltf --size 1200x800": "skewed.toml: w: (0, 0, 1) is "
    "not at right angles to the others, as gltf requires; make it orthonormal (Keep orthonormal",
    "parallel.toml --to opencv --size 9x9": "parallel.toml: ",
    "set.json#3": "set.json: holds no camera '3'; give a number from 0 to 2 or one of",
    "lens.json --to gltf -o a.gltf": "lens.json: a.lens: brown is a lens that gltf cannot hold",
    "set.json --pixel-origin edge": "camera: argument --pixel-origin: invalid choice: 'edge'",
}


@pytest.mark.parametrize("words", MISTAKES)
def test_a_mistake_is_one_line_and_nothing_is_written(capsys, words):
    line = refused(capsys, "camera", *(words.split(" ") if words else [""]))
    assert line.startswith(MISTAKES[words].removeprefix("camera: ")), line


def test_a_folder_that_cannot_be_written(capsys, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: not str(path).endswith("folder"))
    line = refused(capsys, "camera", "set.json#0", "-o", "folder/a.toml")
    assert re.match(r"folder/.*: folder .*folder is not writable; ", line)


class TestView:
    """--view of the commands that draw."""

    def draw(self, capsys, *words: str) -> tuple[np.ndarray, str]:
        arguments = ["render", "spheres", "--renderer", "ray", "--channel", "depth", "-o", "d.npy"]
        assert main([*arguments, *words]) == 0
        return np.load("d.npy"), capsys.readouterr().err

    def test_the_image_is_the_camera_s_own(self, capsys):
        depth, err = self.draw(capsys, "--view", "set.json#b.jpg")
        assert (depth.shape, err) == ((48, 64), "")
        told(capsys, "set.json#1", "-o", "b.toml")
        same, _ = self.draw(capsys, "--view", "b.toml", "--size", "64x48")
        assert np.array_equal(depth, same)
        assert np.isfinite(depth).any()

    def test_another_size_and_another_shape(self, capsys):
        depth, err = self.draw(capsys, "--view", "set.json#1", "--size", "32x24")
        assert (depth.shape, err) == ((24, 32), "")
        depth, err = self.draw(capsys, "--view", "set.json#1", "--size", "20x20")
        assert depth.shape == (20, 20)
        assert re.fullmatch("lucida: --size: 20x20 has another shape .* 64x48: .*\n", err)
        _, err = self.draw(capsys, "--view", "set.json#1", "--size", "20x20", "--fit")
        assert err == ""
        depth, err = self.draw(capsys, "--view", "corner.toml", "--size", "20x10")
        assert (depth.shape, err) == ((10, 20), "")

    def test_a_size_that_the_file_does_not_say_is_told_with_the_reason(self, capsys):
        Path("k.json").write_text(json.dumps({"fx": 90, "fy": 90, "cx": 31.5, "cy": 23.5}))
        line = "lucida: k.json: no image size is given: 64 x 48, centred on the principal point"
        depth, err = self.draw(capsys, "--view", "k.json")
        assert (depth.shape, err) == ((48, 64), f"{line}\n")
        Path("k.json").write_text(
            json.dumps({"fx": 90, "fy": 90, "cx": 3, "cy": 2, "size": [6, 4]})
        )
        assert "image size" not in self.draw(capsys, "--view", "k.json")[1]

    def test_the_window_takes_it_too_in_its_shape(self, monkeypatch):
        seen = {}
        monkeypatch.setattr(launch, "run_viewer", lambda *_, **named: seen.update(named) or 0)
        assert main(["spheres", "--view", "set.json#7"]) == 0
        assert seen["view"].camera.eye == pytest.approx((0, 9, 1))
        assert seen["resolution"] == (32, 48)
        assert main(["spheres", "--view", "corner.toml"]) == 0
        assert seen["resolution"] is None

    @pytest.mark.parametrize(
        ("own", "shown"),
        [((1920, 1200), (1920, 1200)), ((6000, 4000), (1500, 1000)), ((1, 16384), (1, 16384))],
    )
    def test_a_photograph_is_shown_in_a_part_of_its_pixels(self, own, shown):
        assert shown_size(own) == shown

    def test_a_lens_is_taken_off_as_that_of_any_camera(self, capsys):
        words = ["pick", "spheres", "0", "0", "--json", "--view", "lens.json#0"]
        rays = []
        for lens in ([], ["--lens", "none"]):
            assert main([*words, *lens]) == 0
            rays.append(json.loads(capsys.readouterr().out)["ray"]["direction"])
        assert rays[0] != rays[1]

    @pytest.mark.parametrize(
        ("view", "said"),
        [
            ("none.json#1", "none.json: does not exist"),
            (
                "set.json",
                "set.json: holds 3 cameras; give a number .*as in set.json#0$",
            ),
            ("set.json#3", "set.json: holds no camera '3'"),
            ("text.txt", "text.txt: is not a recognised camera format"),
        ],
    )
    @pytest.mark.parametrize("command", ["render", "pick", "view"])
    def test_a_mistake_is_one_line(self, capsys, command, view, said):
        words = {
            "render": ["render", "spheres", "-o", "a.png"],
            "pick": ["pick", "spheres", "0", "0"],
            "view": ["spheres", "--screenshot", "a.png"],
        }[command]
        assert re.match(said, refused(capsys, *words, "--view", view))
