"""`lucida figure`: what it writes, and how it fails."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from launching import launch
from PIL import Image

from tests.support.refusals import refused

SPACE = "{http://www.w3.org/2000/svg}"


def figure(folder: Path, *arguments: str) -> None:
    """Run the command in a process of its own, because it draws a window."""
    command = ["-m", "lucida", "figure", "spheres", "--size", "320x240"]
    done = launch([*command, *arguments], folder)
    assert done.returncode == 0, done.stderr


def test_a_bitmap_has_its_size_and_its_ground(tmp_path):
    figure(tmp_path, "-o", "a.png", "--ground", "transparent")
    pixels = np.asarray(Image.open(tmp_path / "a.png"))
    assert pixels.shape == (240, 320, 4)
    assert (pixels[[0, 0], [0, -1], 3] == 0).all()
    assert (pixels[..., 3] == 255).mean() > 0.2


def test_a_drawing_has_its_size_its_ground_and_its_labels(tmp_path):
    figure(tmp_path, "-o", "a.svg", "--ground", "white", "--mark", "120,160")
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert (root.get("width"), root.get("height")) == ("320", "240")
    assert {"u", "v", "w", "e"} <= {"".join(one.itertext()) for one in root.iter(f"{SPACE}text")}
    assert list(root.iter(f"{SPACE}rect"))


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["-o", "a.gif"], "is not a figure's name"),
        (["-o", "a.png", "--what", "probe"], "add --mark"),
        (["-o", "a.png", "--mark", "999,0"], "outside of the image"),
        (["-o", "a.png", "--mark", "one"], "is not a pixel"),
    ],
)
def test_a_mistake_costs_one_line(tmp_path, monkeypatch, capsys, arguments, told):
    monkeypatch.chdir(tmp_path)
    assert told in refused(capsys, "figure", "spheres", "--size", "320x240", *arguments)
