"""Broken, empty, huge and hostile files: one clear line each, in little time and memory."""

from __future__ import annotations

import os
import random
import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lucida.renderer.files import load_scene, load_view
from lucida.renderer.system.errors import LucidaError

ENDINGS = ("obj", "ply", "stl", "off", "glb", "gltf", "toml")
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
MOST_BYTES = 32 << 20  # what refusing a small file may take


def refusal(path: Path, load: Callable[[Path], Any] = load_scene) -> str:
    """The line with which the file is refused."""
    load_scene("spheres")  # what is imported for the first time is not counted below
    tracemalloc.start()
    try:
        with pytest.raises(LucidaError) as caught:
            load(path)
        assert tracemalloc.get_traced_memory()[1] < MOST_BYTES
    finally:
        tracemalloc.stop()
    line = str(caught.value)
    assert line.startswith(f"{path}: ")
    assert caught.value.remedy
    assert "\n" not in line
    return line.removeprefix(f"{path}: ")


def write(path: Path, content: str | bytes) -> Path:
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


# Files that are no such file.


@pytest.mark.parametrize("ending", ENDINGS)
class TestAnyEnding:
    def test_an_empty_file_is_refused(self, ending: str, tmp_path: Path) -> None:
        assert refusal(write(tmp_path / f"x.{ending}", b"")).startswith("is empty")

    def test_a_missing_file_is_refused(self, ending: str, tmp_path: Path) -> None:
        assert refusal(tmp_path / f"x.{ending}").startswith("does not exist")

    def test_a_folder_is_refused(self, ending: str, tmp_path: Path) -> None:
        (tmp_path / f"x.{ending}").mkdir()
        assert refusal(tmp_path / f"x.{ending}").startswith("is a folder")

    @pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no pipes among files")
    def test_a_pipe_that_nobody_writes_to(self, ending: str, tmp_path: Path) -> None:
        os.mkfifo(tmp_path / f"x.{ending}")
        assert refusal(tmp_path / f"x.{ending}").startswith("is not an ordinary file")

    def test_ten_gigabytes_are_refused(self, ending: str, tmp_path: Path) -> None:
        path = write(tmp_path / f"x.{ending}", b"")
        os.truncate(path, 10 << 30)
        assert refusal(path).startswith("is too large, 10 GiB; stay within ")

    @pytest.mark.parametrize("seed", range(3))
    def test_noise_is_refused(self, ending: str, seed: int, tmp_path: Path) -> None:
        noise = random.Random(seed).randbytes(5000)
        refusal(write(tmp_path / f"x.{ending}", noise))


def test_a_hostile_view_file_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "v.toml", b"")
    os.truncate(path, 10 << 30)
    assert refusal(path, load_view).startswith("is too large")
    assert refusal(tmp_path, load_view).startswith("is a folder")
    assert refusal(tmp_path / "none.toml", load_view).startswith("does not exist")
    assert refusal(write(path, b"\xff"), load_view).startswith("line 1: is not text in UTF-8")


# OBJ.


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            TRIANGLE + "f 1 2\n",
            "line 4: 'f 1 2' is not valid in an OBJ with 3 vertices; repair",
        ),
        (TRIANGLE + "f 1 2 9\n", "line 4: 'f 1 2 9' is not valid"),
        (TRIANGLE + "f 1 2 -4\n", "line 4: 'f 1 2 -4' is not valid"),
        ("v a b c\n" + TRIANGLE + "f 1 2 3\n", "line 1: 'v a b c' is not valid"),
        ("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "vertices: 1 of 3 are NaN or too large"),
        ("v 0 0 0\nv 1e-7 0 0\nv 0 1e-7 0\nf 1 2 3\n", "is too small, 1.41421e-07 across"),
        (
            TRIANGLE + "f 1///1 2 3\nf 1 2 3\n",
            "cannot be read as OBJ; export it again",
        ),
        ("v 0 0 0\nv 1 0 0 # of 0,5\nv 0 1,5 0\nf 1 2 3\n", "line 3: 'v 0 1,5 0' is not valid"),
    ],
)
def test_a_hostile_obj_is_refused(text: str, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.obj", text)).startswith(message)


@pytest.mark.parametrize("end", ["f 2", "f 2/1", "f 1/1 2/1\n\n"])
def test_an_obj_that_ends_within_a_face_is_refused(end: str, tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n"
    assert refusal(write(tmp_path / "x.obj", text + end)).startswith(f"line 6: {end.strip()!r}")
    assert load_scene(write(tmp_path / "x.obj", text + "f 1/1 2/1 3/1")).objects


# PLY.


def ply(vertices: int | str, faces: int | str, form: str = "ascii") -> str:
    return (
        f"ply\nformat {form} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {faces}\nproperty list uchar int vertex_indices\n"
        "end_header\n"
    )


POINTS = "0 0 0\n1 0 0\n0 1 0\n"
BINARY = "binary_little_endian"
UNLIKE = "does not hold the data that its PLY header declares"
BINARY_POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (ply(3, 4_000_000_000) + POINTS, UNLIKE),
        (ply(3, 2) + POINTS + "3 0 1 2\n", UNLIKE),
        (ply(-3, 1) + POINTS, UNLIKE),
        (ply("1e9", 1) + POINTS, UNLIKE),
        (ply(3, 1) + POINTS + "3 0 1 7\n", "faces: use vertex 7 of 3"),
        (ply(3, 1) + POINTS.replace("1", "x") + "3 0 1 2\n", UNLIKE),
        (ply(3, 1).replace("float x", "foo x") + POINTS + "3 0 1 2\n", UNLIKE),
        (ply(3, 1).replace("end_header", ""), "has no PLY header"),
        (
            ply(3, 1, BINARY).replace("uchar int", "int int").encode()
            + BINARY_POINTS
            + struct.pack("<4i", -5, 0, 1, 2),
            UNLIKE,
        ),
        (
            ply(3, 1, BINARY).replace("uchar int", "uint int").encode()
            + BINARY_POINTS
            + struct.pack("<I3i", 4_000_000_000, 0, 1, 2),
            UNLIKE,
        ),
    ],
)
def test_a_hostile_ply_is_refused(content: str | bytes, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.ply", content)).startswith(message)


# STL.

FACET = (
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
)


def stl(declared: int, triangles: int, value: float = 0.0) -> bytes:
    one = struct.pack("<12fH", 0, 0, 1, value, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    return bytes(80) + struct.pack("<I", declared) + one * triangles


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            stl(4_000_000_000, 1),
            "is not an STL of 4000000000 triangles: it has 134 bytes",
        ),
        (stl(2000, 1999), "is not an STL of 2000 triangles: it has 100,034 bytes"),
        (stl(1, 1)[:60], "is not an STL of 0 triangles"),
        (f"solid x\n{FACET}", "is not an STL"),
        (f"solid x\n{FACET.replace('vertex 1 0 0', 'vertex 1 0')}endsolid\n", "has a vertex"),
    ],
)
def test_a_hostile_stl_is_refused(content: str | bytes, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.stl", content)).startswith(message)


# OFF.


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("OFF\n-3 -1 0\n0 0 0\n", "does not hold the data that its OFF header"),
        ("OFF\n3000000000 1000000000 0\n0 0 0\n", "does not hold the data that its OFF header"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n", "faces: use vertex 9 of 3"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1\n3 0 1 2\n", "does not hold the data that its OFF header"),
        ("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "does not begin with OFF"),
        ("4OFF\n1 1 1\n", "does not begin with OFF"),
    ],
)
def test_a_hostile_off_is_refused(text: str, message: str, tmp_path: Path) -> None:
    assert refusal(write(tmp_path / "x.off", text)).startswith(message)
