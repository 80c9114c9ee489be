"""The renderers see what Embree saw in three scenes (tools/embree_hits.py has recorded it)."""

import numpy as np
import pytest

from lucida import Rasterizer, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS
from lucida.renderer.scene.model import Scene, SceneObject
from tools.embree_hits import RECORDED, SCENES, SIZE

ON_EDGES = 0.005  # of the pixels: their centres are on an edge, in float32


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("renderer", [Rasterizer, Tracer])
def test_the_same_triangles_at_the_same_places(name, renderer):
    mesh, camera = SCENES[name]
    with np.load(RECORDED) as data, renderer(Scene((SceneObject(mesh),))) as drawing:
        frame = drawing.render(camera, SIZE, CHANNELS)
        primitive, depth = data[f"{name}-primitive"], data[f"{name}-depth"]
    same = frame.primitive == primitive
    assert 0.1 < (primitive >= 0).mean() < 1
    assert (~same).mean() <= ON_EDGES
    np.testing.assert_allclose(frame.depth[same], depth[same], rtol=1e-4)
