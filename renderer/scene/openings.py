"""Openings: where rays pass through triangles that they meet, unseen backs and holes.

For code that computes on arrays of hits, outside the renderers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.scene.flat import FlatScene
from renderer.scene.sampling import F64, Ints, on_triangles, opacity


def are_passed(
    flat: FlatScene, triangles: Ints, weights: F64, direction: F64, is_light: bool = False
) -> NDArray[np.bool_]:
    """Return which of some triangles (n,) a ray passes where it meets them.

    weights (n, 3): barycentrics. direction (3,): the ray's, in the world. is_light: light passes no
    backs.
    """
    owner = flat.face_object[triangles]
    passed = (flat.single_sided[owner] > 0) & (not is_light)
    if passed.any():
        one_sided, matrix = triangles[passed], flat.world_from_object[owner[passed], :3, :3]
        a, b, c = np.moveaxis(flat.vertices[flat.faces[one_sided]].astype(np.float64), 1, 0)
        inside = np.linalg.solve(matrix, np.broadcast_to(direction[:, None], (len(a), 3, 1)))
        passed[passed] = np.einsum("ni,ni->n", np.cross(b - a, c - a), inside[..., 0]) > 0
    holed = flat.textures[owner, 1, 1] >= 0
    if holed.any():
        places = on_triangles(flat, triangles[holed], weights[holed])
        passed[holed] |= opacity(flat, owner[holed], places)[:, 0] < 0
    return passed
