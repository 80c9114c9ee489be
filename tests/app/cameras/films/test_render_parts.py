"""`lucida render` of a large image, in parts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from PIL import Image

from lucida import Camera, LucidaError, Tracer, load_scene
from lucida.app.cli import main
from lucida.app.commands import render_parts
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.images import picture
from tests.support.refusals import refused

SCENE, SIZE = load_scene("still-life"), (80, 100)


@pytest.fixture
def render(tmp_path, monkeypatch, capsys):
    """Return a function that runs the command, for which 80 x 64 pixels are many."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("lucida.renderer.images.frame.LARGEST_PIXELS", 80 * 64)
    monkeypatch.setattr(render_parts, "LARGEST_PIXELS", 80 * 64)
    monkeypatch.setattr(render_parts, "PART_PIXELS", 80 * 32)

    def run(*arguments):
        status = main(["render", "still-life", *arguments])
        return status, *capsys.readouterr()

    return run


def image(path):
    return np.asarray(Image.open(path)).astype(int)


@pytest.mark.parametrize("lens", [None, Lens("equidistant")])
def test_rows_have_the_bits_of_the_whole_image(lens):
    view = SCENE.view.for_size(SIZE)
    camera = Camera(view.eye, view.u, view.v, view.w, view.distance, view.viewport, lens=lens)
    channels = ("color", "depth", "normal", "primitive")
    with Tracer(SCENE, shadows=True, mirror_depth=2) as tracer:
        whole = tracer.render(camera, SIZE, channels, 4)
        for rows in ((0, 32), (32, 96), (96, 100)):
            part = tracer.render(camera, SIZE, channels, 4, rows=rows)
            assert part.size == (80, rows[1] - rows[0])
            for name in channels:
                wanted = whole.channel(name)[slice(*rows)]
                assert part.channel(name).tobytes() == wanted.tobytes()
        with pytest.raises(LucidaError, match=r"rows: \(90, 101\) are not in 0 to 100"):
            tracer.render(camera, SIZE, rows=(90, 101))


def test_a_large_image_is_that_of_its_parts(render):
    options = ("--samples", "4", "--shadows", "--renderer", "ray")
    size = ("--size", "80x100")
    status, out, _ = render("-o", "parts.png", *size, *options)
    assert status == 0 and out.startswith("parts.png: color, ray, 80x100, ")
    assert render("-o", "ids.exr", *size, "--channel", "id", *options)[0] == 0
    assert render("-o", "raster.png", *size)[0] == 0
    with Tracer(SCENE, shadows=True) as tracer:
        for first in (0, 50):  # two halves are not large
            rows = first, first + 50
            camera = SCENE.view.for_size(SIZE).cropped(rows, SIZE)
            half = tracer.render(camera, (80, 50), ("color", "id"), 4)
            with OpenEXR.File("ids.exr", separate_channels=True) as file:
                ids = file.channels()["id"].pixels[slice(*rows)].view(np.int32)
            assert (ids != half.id).mean() < 1e-3
            off = np.abs(image("parts.png")[slice(*rows)] - picture(half))
            assert (off > 1).mean() < 1e-3
    assert (np.abs(image("raster.png") - image("parts.png")) > 8).mean() < 0.3
    assert not list(Path().glob("*.frames"))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("-o", "a.npy", "--size", "80x100"), "80x100 is drawn in parts, which .npy cannot be"),
        (("-o", "a.png", "--size", "80x100", "--channel", "depth"), "no nearest hit in common"),
        (
            ("-o", "a.pfm", "--size", "32x18", "--workers", "2"),
            "draws an image in parts, which .pfm cannot be",
        ),
        (("-o", "a.png", "--size", "20000x2"), "20000x2 is too large"),
        (("-o", "a", "--all"), "--all: is no longer part of Lucida; `lucida render --view SET#1"),
    ],
)
def test_mistakes_with_parts_cost_one_line(render, capsys, options, message):
    assert message in refused(capsys, "render", "still-life", *options)
