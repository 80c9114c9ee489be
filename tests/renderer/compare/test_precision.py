"""The limits of float32: what is compared agrees, and what would not is refused in one line."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida.renderer.compare.raster_and_ray import compare
from lucida.renderer.files import load_scene
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.precision import check_precision
from lucida.renderer.system.errors import LucidaError

SIZE = (64, 36)
SPHERES = load_scene("spheres")
FLAT = flatten(SPHERES)


def changed(name, factor):
    camera = SPHERES.view.for_size(SIZE)
    if name == "distance":
        return replace(camera, distance=camera.distance * factor)
    if name == "eye":  # as far away as the view is narrow
        eye = tuple(np.array(camera.eye) * factor)
        return replace(camera, eye=eye, distance=camera.distance * factor)
    if name == "parallel":
        camera = replace(camera, projection="parallel")
    return replace(camera, viewport=tuple(edge / factor for edge in camera.viewport))


def refusal(camera):
    try:
        check_precision(camera, SIZE, lambda: FLAT)
    except LucidaError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("exponent", [-11, -8, -5, -3, 0, 4, 7, 8, 9, 10, 11])
@pytest.mark.parametrize("name", ["distance", "viewport", "eye", "parallel"])
def test_a_camera_is_refused_or_both_images_agree(name, exponent, gl_backend):
    camera = changed(name, 10.0**exponent)
    said = refusal(camera)
    if not said:
        assert compare(SPHERES, camera, SIZE, gl_backend).unexplained == 0
        return
    assert not -3 <= exponent <= 6
    with pytest.raises(LucidaError, match=r"^camera: .* for the 24 bits of float32") as raised:
        compare(SPHERES, camera, SIZE, gl_backend)
    assert "\n" not in str(raised.value)


@given(st.floats(1e-9, 179.999999999))
def test_the_bounds_are_on_either_side_of_usual_views(fov_deg):
    camera = replace(SPHERES.view.camera, distance=0.5 / math.tan(math.radians(fov_deg) / 2))
    said = refusal(camera)
    if said:
        assert not 1e-5 < fov_deg < 179.9
        assert ("too wide" in said) == (fov_deg > 90)
    else:
        assert 1e-8 < fov_deg < 179.9999
