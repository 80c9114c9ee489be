"""Three small pictures whose pixels were computed by hand: an error that all renderers share shows.

sRGB's curve, of which every picture has some values: 0.125 is 99, 0.25 is 137, 0.5 is 188.
"""

import math

import numpy as np
import pytest

from lucida import Camera, Rasterizer, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS
from lucida.renderer.images import picture
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)

NO = math.inf
WHITE = (1.0, 1.0, 1.0)
RENDERERS = {
    "raster": Rasterizer,
    "tiles": Tracer,
    "reference": lambda scene: Tracer(scene, method="reference"),
}


@pytest.fixture(params=RENDERERS)
def drawn(request):
    """Return a function that draws a scene: (8-bit picture, frame)."""

    def draw(scene, camera, size):
        with RENDERERS[request.param](scene) as renderer:
            frame = renderer.render(camera, size, CHANNELS)
        return picture(frame), frame

    return draw


def test_half_a_wall_has_the_values_computed_by_hand(drawn):
    """The canonical camera, 4 x 2: u is -3/8, -1/8, 1/8 and 3/8, and the wall begins at x = 0.

    At z = -2 every ray (u, v, -1) has t = 2. Of the light from (0.6, 0, 0.8), the wall gets 0.8 and
    of the ambient light 0.2: it is as bright as its reflectance.
    """
    corners = [(0, -4, -2), (4, -4, -2), (4, 4, -2), (0, 4, -2)]
    wall = Mesh(corners, [(0, 1, 2), (0, 2, 3)])
    scene = Scene(
        (SceneObject(wall, Material((0.5, 0.25, 0.125), (0, 0, 0))),),
        (DirectionalLight((-0.6, 0, -0.8), WHITE),),
        ambient=(0.2, 0.2, 0.2),
        background=(0.0, 0.0, 0.2),
    )
    shown, frame = drawn(scene, Camera.canonical(), (4, 2))
    sky, lit = (0, 0, 124), (188, 137, 99)
    assert shown.tolist() == [[list(sky)] * 2 + [list(lit)] * 2] * 2
    np.testing.assert_allclose(frame.depth, [[NO, NO, 2, 2]] * 2, rtol=1e-6)


def test_a_ball_with_a_highlight(drawn):
    """3 x 3: a ray (1/3, 0, -1) meets the ball of radius 1 about (0, 0, -3) at
    t = (3 - sqrt(9 - 10/9 * 8)) / (10/9) = 2.4, in (0.8, 0, -2.4), with the normal (0.8, 0, 0.6).

    The light is in the eye: n.l = n.h = (-0.8 + 3 * 0.6) / sqrt(10) = 0.31623 there, so that it
    sends 0.4 * 0.31623 + 0.5 * 0.31623^2 = 0.17649; in the middle it sends 0.4 + 0.5.
    """
    ball = SceneObject(Sphere((0, 0, -3), 1.0), Material((0.4,) * 3, (0.5,) * 3, 2))
    scene = Scene((ball,), (PointLight((0, 0, 0), WHITE),), ambient=(0, 0, 0), background=(0, 0, 0))
    shown, frame = drawn(scene, Camera.canonical(), (3, 3))
    assert shown[..., 0].tolist() == [[0, 117, 0], [117, 243, 117], [0, 117, 0]]
    depth = [[NO, 2.4, NO], [2.4, 2, 2.4], [NO, 2.4, NO]]
    np.testing.assert_allclose(frame.depth, depth, rtol=1e-5)
    np.testing.assert_allclose(
        frame.normal[1], [(-0.8, 0, 0.6), (0, 0, 1), (0.8, 0, 0.6)], atol=1e-5
    )
    np.testing.assert_allclose(frame.normal[0, 1], (0, 0.8, 0.6), atol=1e-5)  # row 0 is at the top


def test_a_coloured_triangle_in_parallel_projection(drawn):
    """4 x 2 pixels over 0 < x < 4, 0 < y < 2: the lower row is y = 0.5, the upper one 1.5.

    The triangle is where y < x / 2, in the plane z = -x: from z = 1, t = 1 + x. The colours of its
    corners make red x / 4 and green y / 2, and the light meets it at a right angle.
    """
    corners, colors = [(0, 0, 0), (4, 0, -4), (4, 2, -4)], [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
    triangle = SceneObject(Mesh(corners, [(0, 1, 2)], colors=colors), Material(WHITE, (0, 0, 0)))
    scene = Scene(
        (triangle,),
        (DirectionalLight((-1, 0, -1), WHITE),),
        ambient=(0, 0, 0),
        background=(0, 0, 0),
    )
    camera = Camera(eye=(0, 0, 1), viewport=(0, 4, 0, 2), projection="parallel")
    shown, frame = drawn(scene, camera, (4, 2))
    no = [0, 0, 0]
    assert shown.tolist() == [
        [no, no, no, [240, 225, 0]],
        [no, [165, 137, 0], [207, 137, 0], [240, 137, 0]],
    ]
    np.testing.assert_allclose(frame.depth, [[NO, NO, NO, 4.5], [NO, 2.5, 3.5, 4.5]], rtol=1e-6)
    assert (frame.id == [[-1, -1, -1, 0], [-1, 0, 0, 0]]).all()
