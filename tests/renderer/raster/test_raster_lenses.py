"""Images through lenses, looked up in pinhole images, against float64 rays."""

from dataclasses import replace

import numpy as np
import pytest
from raster_scenes import still_life
from trace_reference import reference

from lucida import Camera, LucidaError
from lucida.renderer.camera.lens_faces import looked_up_faces
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.scene.flat import flatten

SIZE = (36, 24)
EYE = Camera.look_at((2, 1.5, 4), (0, 0, 0), aspect=1.5)
# Each lens, and half the width of its viewport.
LENSES = {
    "brown": (Lens("brown", {"k1": -0.2, "p1": 0.02, "k4": 0.05}), 0.8),
    "wide brown": (Lens("brown", {"k1": 0.1}), 2.9),
    "fisheye": (Lens("fisheye", {"k1": 0.05}), 1.9),
    "fov": (Lens("fov", {"omega": 0.9}), 0.9),
    "thin_prism_fisheye": (Lens("thin_prism_fisheye", {"k1": 0.02, "sx1": 0.01}), 1.1),
    "equidistant": (Lens("equidistant"), 3.3),
    "stereographic": (Lens("stereographic"), 3.5),
    "equisolid": (Lens("equisolid"), 2.2),
    "orthographic": (Lens("orthographic"), 1.1),
    "equirectangular": (Lens("equirectangular"), np.pi),
    "cylindrical": (Lens("cylindrical"), 2.6),
}


def through(name, **changes):
    """A skewed camera with one of LENSES."""
    lens, half = LENSES[name]
    camera = replace(EYE, lens=lens, distance=0.7, u=tuple(np.add(EYE.u, (0, 0.1, 0))))
    half *= camera.distance
    return replace(camera, viewport=(-half, half, -half / 1.5, half / 1.5), **changes)


@pytest.mark.parametrize("name", LENSES)
def test_looked_up_pixels_differ_only_by_a_texel(rasterizer, name):
    scene, camera = still_life(), through(name, near=1.5, far=9.0)
    flat, ray = flatten(scene), reference(scene, camera, SIZE)
    rasterizer.set_scene(scene)
    differing = []
    for enlargement in (1, 4):
        frame = rasterizer.render(camera, SIZE, CHANNELS, enlargement=enlargement)
        result = compare_frames(flat, camera, SIZE, frame, ray, enlargement=enlargement)
        assert result.unexplained == 0, result.summary()
        differing.append(result.pixels - result.agree)
        assert result.outside == np.isnan(camera.rays(SIZE).direction[..., 0]).sum()
    assert differing[1] < differing[0] < 0.2 * result.pixels


def test_a_lens_that_does_nothing_shows_the_pinholes_image(rasterizer):
    scene = still_life()  # without the floor, which extends behind the eye
    rasterizer.set_scene(replace(scene, objects=scene.objects[1:]))
    camera = replace(through("brown"), lens=Lens("brown"))
    pinhole = rasterizer.render(camera.pinhole, SIZE, CHANNELS)
    frame = rasterizer.render(camera, SIZE, CHANNELS, enlargement=1)
    np.testing.assert_array_equal(frame.primitive, pinhole.primitive)
    np.testing.assert_allclose(frame.depth, pinhole.depth, rtol=1e-5)
    np.testing.assert_allclose(frame.color, pinhole.color, atol=1e-4)


def test_samples_and_a_lens_that_sees_nothing(rasterizer):
    rasterizer.set_scene(still_life())
    four = rasterizer.render(through("fisheye"), SIZE, samples=4)
    one = rasterizer.render(through("fisheye"), SIZE)
    assert 0 < np.abs(four.color - one.color).mean() < 0.1
    beyond = replace(through("orthographic"), viewport=(5, 6, 5, 6))
    frame = rasterizer.render(beyond, SIZE, CHANNELS)
    assert (frame.primitive == -1).all()
    assert np.allclose(frame.color, still_life().background)


def test_a_panorama_has_six_faces_and_a_narrow_lens_one():
    assert len(looked_up_faces(through("equirectangular"), SIZE).faces) == 6
    assert len(looked_up_faces(through("brown"), SIZE).faces) == 1


def test_an_enlargement_out_of_the_list_is_refused(rasterizer):
    with pytest.raises(LucidaError, match="enlargement"):
        rasterizer.render(through("brown"), SIZE, enlargement=3)
