"""glTF files that show the same numbers again and again: made once, counted before that."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gltf_files import gltf, load_gltf

from lucida.renderer.system.cancelling import cancelled_by
from lucida.renderer.system.errors import LucidaError


def shared(
    positions: np.ndarray, indices: list[np.ndarray], instances: int = 1, own: bool = True
) -> dict[str, Any]:
    """Return a tree of one mesh with a primitive for each list of indices, at several nodes.

    own: each primitive has accessors of its own, to the same numbers.
    """
    points = positions.astype("<f4")
    primitives = [
        {"POSITION": points.copy() if own else points, "indices": faces.astype("<u4").ravel()}
        for faces in indices
    ]
    nodes = [{"mesh": 0, "translation": [2.0 * n, 0, 0]} for n in range(instances)]
    return gltf(*primitives, nodes=nodes, scenes=[{"nodes": list(range(instances))}])


CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1.0]])
FACES = [np.array([[0, 1, 2]]), np.array([[1, 3, 2], [0, 1, 4]])]


def test_one_buffer_shown_a_thousand_times_is_built_once(tmp_path: Path, monkeypatch) -> None:
    from lucida.renderer.files.models import models

    built = []
    build = models.build_mesh
    monkeypatch.setattr(models, "build_mesh", lambda part: built.append(part) or build(part))
    objects = load_gltf(shared(CORNERS, FACES[:1] * 500, instances=2), tmp_path).objects
    assert len(objects) == 1000
    assert len(built) == 1
    assert len({id(entry.shape.faces) for entry in objects}) == 1


def test_primitives_of_one_list_of_vertices_have_only_their_own(tmp_path: Path) -> None:
    one, two = load_gltf(shared(CORNERS, FACES, own=False), tmp_path).objects
    assert (one.shape.vertices == CORNERS[:3]).all()
    assert {tuple(v) for v in two.shape.vertices} == {tuple(v) for v in CORNERS[[0, 1, 2, 3, 4]]}
    assert len(two.shape.faces) == 2


def test_reading_is_left_between_two_primitives(tmp_path: Path, monkeypatch) -> None:
    from lucida.renderer.files.models import models

    build, built = models.build_mesh, []
    monkeypatch.setattr(models, "build_mesh", lambda part: built.append(part) or build(part))

    def check() -> None:
        if built:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), cancelled_by(check):
        load_gltf(shared(CORNERS, FACES), tmp_path)
    assert len(built) == 1


def test_what_is_too_much_is_refused_before_it_is_read(tmp_path: Path, monkeypatch) -> None:
    tree = shared(CORNERS, FACES[:1] * 4, instances=3)
    load_gltf(tree, tmp_path)
    monkeypatch.setattr("lucida.renderer.files.models.gltf.TRIANGLES", 11)
    monkeypatch.setattr("lucida.renderer.files.models.gltf_file.OpenGltf.view", None)
    with pytest.raises(LucidaError, match="has 12 triangles; stay within 11"):
        load_gltf(tree, tmp_path)
