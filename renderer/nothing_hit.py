"""Why an image shows nothing: no objects, all behind the eye, all cut off, or none in view.

Pure. Asked only where nothing is hit, so that it may look at every triangle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.frame import Frame
from renderer.scene.flat import FlatScene
from renderer.scene.positions import world_vertices


def hits_nothing(*frames: Frame) -> bool:
    """Whether no pixel of any of the frames, which hold the channel id, hits anything."""
    return all(not (frame.channel("id") >= 0).any() for frame in frames)


def why_nothing_is_hit(flat: FlatScene, camera: Camera) -> str:
    """The reason, in a few words, for an image of this camera in which nothing is hit."""
    low, high = _parameters(flat, camera)
    near, far = camera.t_range
    behind, count = int(np.count_nonzero(high <= 0)), len(high)
    if not count:
        return "the scene has no objects"
    if behind == count:
        return "everything is behind the eye"
    if not (high > near).any():
        return f"everything is behind the eye or nearer than near = {camera.near:g}"
    if not (low < far).any():
        return f"everything is farther than far = {camera.far:g}"
    some = f"; {behind} of {count} are behind the eye" if behind else ""
    return f"no viewing ray meets an object{some}"


def middle_of(flat: FlatScene) -> tuple[float, float, float]:
    """The middle of the scene's bounds: something to look at."""
    x, y, z = flat.bounds.astype(float).mean(axis=0).tolist()
    return x, y, z


def _parameters(flat: FlatScene, camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The smallest and the largest ray parameter of each object that is not hidden: the depth along
    -w, in units of the distance (perspective) or of w (parallel)."""
    unit = 1.0 if camera.is_parallel else camera.distance
    back = -camera.camera_from_world[2] / unit
    low, high = np.full((2, len(flat.object_sphere)), np.inf)
    corners = (world_vertices(flat) @ back[:3] + back[3])[flat.faces]
    np.minimum.at(low, flat.face_object, corners.min(axis=1))
    np.minimum.at(high, flat.face_object, -corners.max(axis=1))
    centers = flat.spheres[:, :3] @ back[:3] + back[3]
    reach = flat.spheres[:, 3] * np.linalg.norm(back[:3])
    low[flat.sphere_object] = centers - reach
    high[flat.sphere_object] = -centers - reach
    seen = np.isfinite(low)  # the others are hidden
    return low[seen], -high[seen]
