"""`lucida pick`: the numbers of one pixel are those of the image."""

from __future__ import annotations

import json

import numpy as np
import pytest

from lucida import Tracer, load_scene
from lucida.app.cli import main

SIZE = (64, 36)
PIXEL = (20, 30)


def pick(capsys, *words: str) -> dict:
    assert main(["pick", "spheres", *words, "--size", "64x36", "--json"]) == 0
    told = capsys.readouterr()
    assert told.err == ""
    return json.loads(told.out)


@pytest.fixture(scope="module")
def image():
    scene = load_scene("spheres")
    camera = scene.view.for_size(SIZE)
    with Tracer(scene) as tracer:
        return scene, camera, tracer.render(camera, SIZE)


def test_a_pixel_is_the_image_s(capsys, image):
    scene, camera, frame = image
    seen = pick(capsys, *map(str, PIXEL))
    number = int(frame.id[PIXEL])
    assert seen["object"] == {"id": number, "name": scene.objects[number].name}
    assert seen["t"] == frame.depth[PIXEL]
    assert seen["normal"] == frame.normal[PIXEL].tolist()
    assert seen["color"] == frame.color[PIXEL].tolist()
    ray = camera.ray(*PIXEL, SIZE)
    assert np.isclose(seen["z"], camera.z_from_t(frame.depth, SIZE)[PIXEL])
    assert np.allclose(seen["point"], ray.origin + frame.depth[PIXEL] * ray.direction)
    assert seen["ray"]["direction"] == ray.direction.tolist()
    assert (seen["pixel"], seen["size"]) == ([20, 30], [64, 36])


def test_the_background_has_no_object(capsys):
    seen = pick(capsys, "0", "0", "--eye", "0,0,90")
    assert [seen[name] for name in ("object", "t", "point", "normal")] == [None] * 4
    assert main(["pick", "spheres", "0", "0", "--size", "64x36", "--eye", "0,0,90"]) == 0
    assert "none: the background" in capsys.readouterr().out


def test_the_text_has_every_quantity_and_says_from_where(capsys):
    assert main(["pick", "spheres", "20", "30", "--size", "64x36"]) == 0
    lines = dict(line.split(None, 1) for line in capsys.readouterr().out.splitlines()[:6])
    assert lines["pixel"] == "row 20, column 30 of 64x36, from 0"
    assert list(lines) == ["pixel", "object", "t", "z", "point", "normal"]


def test_a_pixel_outside_of_the_lens_has_no_ray(capsys: pytest.CaptureFixture[str]) -> None:
    outside = ["pick", "spheres", "0", "0", "--size", "8x8", "--lens", "orthographic"]
    outside += ["--viewport=-2,2,-2,2", "--distance", "1"]
    assert main(outside) == 0
    told = capsys.readouterr().out
    assert "none: outside of the lens" in told and "nan" not in told
    assert main([*outside, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ray"] is None
