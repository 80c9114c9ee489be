"""Files with some bytes changed, or cut off anywhere: read or refused."""

from __future__ import annotations

import json
import random
from pathlib import Path

import numpy as np
import pytest
from test_gltf_hostile import IN_CHUNK, TREE, glb
from test_scene_hostile import BINARY, BINARY_POINTS, FACET, POINTS, TRIANGLE, ply, stl, write

from lucida.renderer.files import load_scene
from lucida.renderer.scene import flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

SOUND: dict[str, bytes] = {
    "obj": (TRIANGLE + "vn 0 0 1\nvt 0 0\no a\nf 1/1/1 2/1/1 3/1/1\n").encode(),
    "ply": ply(3, 1, BINARY).encode() + BINARY_POINTS + b"\3" + bytes(range(3)) + bytes(9),
    "ascii.ply": (ply(3, 1) + POINTS + "3 0 1 2\n").encode(),
    "stl": stl(1, 1),
    "ascii.stl": f"solid x\n{FACET}endsolid x\n".encode(),
    "off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "glb": glb(IN_CHUNK),
    "gltf": json.dumps(TREE).encode(),
    "toml": b'lucida = 1\n[[objects]]\ntype = "torus"\nsegments = 9\n[camera]\neye = [0, 0, 1]\n',
}


def sound_or_refused(path: Path) -> Scene | None:
    try:
        scene = load_scene(path)
    except LucidaError:
        return None
    assert all(np.isfinite(array).all() for array in flatten(scene))
    return scene


@pytest.mark.parametrize("name", SOUND)
def test_files_with_a_few_wrong_bytes_are_read_or_refused(name: str, tmp_path: Path) -> None:
    path = tmp_path / f"x.{name}"
    write(path, SOUND[name])
    if name != "ply":  # its indices are not meant to be right
        assert sound_or_refused(path) is not None
    dice = random.Random(name)
    for _ in range(120):
        data = bytearray(SOUND[name])
        for _ in range(dice.choice([1, 1, 2, 4])):
            at = dice.randrange(len(data))
            kind = dice.randrange(4)
            if kind == 0:
                data[at] = dice.randrange(256)
            elif kind == 1:
                data[at : at + 1] = dice.choice(
                    [b"9", b"-", b"0", b"\n", b" ", b"e", b"/", b"\xff"]
                )
            elif kind == 2:
                del data[at : at + dice.choice([1, 4, 20])]
                data = data or bytearray(b"x")
            else:
                data[at:at] = data[max(0, at - 8) : at]
        sound_or_refused(write(path, bytes(data)))


@pytest.mark.parametrize("name", SOUND)
def test_files_cut_off_anywhere_are_read_or_refused(name: str, tmp_path: Path) -> None:
    data = SOUND[name]
    for end in range(1, len(data), max(1, len(data) // 60)):
        sound_or_refused(write(tmp_path / f"x.{name}", data[:end]))
