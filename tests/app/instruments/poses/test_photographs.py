"""The photographs of a set: found, read small, or told why not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from sets_of_cameras import a_set, ring
from waiting import wait_for

from lucida.app.instruments.poses.model import PoseSet, pose_set
from lucida.app.instruments.poses.photographs import (
    SIDE_PX,
    Photographs,
    photo_path,
    read_photograph,
)
from lucida.renderer.files.cameras import CameraSet


def with_images(folder: Path, *images: str, name: str = "") -> PoseSet:
    posed = [replace(ring(1)[0], image=image, name=name) for image in images]
    return pose_set(folder / "transforms.json", CameraSet("nerf", tuple(posed)))


@pytest.mark.parametrize("ending", ["png", "jpg"])
def test_a_photograph_is_read_small_with_its_proportions(tmp_path: Path, ending: str) -> None:
    rows, columns = np.mgrid[0:900, 0:1800]
    pixels = np.stack([rows // 4, columns // 8, 0 * rows], axis=-1).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / f"a.{ending}", quality=95)
    found = read_photograph(with_images(tmp_path, f"a.{ending}"), 0)
    assert found.pixels is not None and found.pixels.shape == (SIDE_PX // 2, SIDE_PX, 3)
    assert found.size == (1800, 900)
    assert found.path == tmp_path / f"a.{ending}" and not found.problem
    corners = found.pixels[[0, 0, -1, -1], [0, -1, 0, -1]].astype(int)
    assert np.abs(corners - pixels[[0, 0, -1, -1], [0, -1, 0, -1]]).max() < 12


def test_what_is_not_there_is_told_by_name(tmp_path: Path) -> None:
    poses = with_images(
        tmp_path, "images/0001.png", str(tmp_path / "images" / "2.png"), "/data/x/3.png"
    )
    problems = [read_photograph(poses, number).problem for number in range(3)]
    assert problems == [
        f"{Path('images/0001.png')} is not there.",
        f"{Path('images/2.png')} is not there.",
        f"{Path('x/3.png')} is not there.",
    ]
    assert read_photograph(with_images(tmp_path, "", name="7.jpg"), 0).problem == (
        "7.jpg is not there."
    )
    nameless = with_images(tmp_path, "")
    assert read_photograph(nameless, 0).problem == "The file names no photograph."
    assert photo_path(nameless, 0) is None
    assert photo_path(poses, 0) == tmp_path / "images" / "0001.png"


@pytest.mark.parametrize("data", [b"", b"no picture", b"\x89PNG\r\n\x1a\n broken", b"\xff\xd8\xff"])
def test_what_is_no_picture_is_told(tmp_path: Path, data: bytes) -> None:
    (tmp_path / "a.png").write_bytes(data)
    found = read_photograph(with_images(tmp_path, "a.png"), 0)
    assert found.pixels is None
    assert found.problem == "a.png is not a readable picture."


def test_they_are_read_in_a_thread_and_the_latest_is_kept(tmp_path: Path) -> None:
    count = 3
    poses = with_images(tmp_path, *(f"{k}.png" for k in range(count)))
    for k in range(count):
        Image.new("RGB", (2, 2), (k, 0, 0)).save(tmp_path / f"{k}.png")
    photographs = Photographs()
    try:
        for k in range(count):
            wait_for(lambda k=k: photographs.of(poses, k) is not None)
            found = photographs.of(poses, k)
            assert found is not None and found.pixels is not None and found.pixels[0, 0, 0] == k
        assert photographs.of(poses, count - 1) is found  # at once
        assert photographs.of(poses, 0) is None  # forgotten: it is read again
        wait_for(lambda: photographs.of(poses, 0) is not None)
        # Each part of what is asked for makes another picture: the set, the camera, the points.
        assert photographs.of(poses, count - 1, True) is None
        wait_for(lambda: photographs.of(poses, count - 1, True) is not None)
        assert photographs.of(a_set(), 0) is None
        assert photographs.busy
        photographs.want_none()
        assert not photographs.busy  # whenever that picture comes
        photographs.forget()
        assert photographs.of(poses, 1) is None
        photographs.forget()
        assert not photographs.busy
    finally:
        photographs.close()
