"""The scenes and cameras of the rasterizer's tests, and its agreement with float64."""

from dataclasses import replace

import numpy as np
from trace_reference import reference

from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.scene import shapes
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    Checker,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)

SIZE = (48, 36)
WIDE = Camera(viewport=(-0.8, 0.8, -0.6, 0.6))
CHECKERED = Material((0.6, 0.5, 0.4), (0.5, 0.5, 0.5), 80, Checker((0.1, 0.2, 0.9), 0.35))


def triangle(*corners, **more):
    return Mesh(np.array(corners, np.float32), np.array([[0, 1, 2]], np.int32), **more)


def square(side, z=0.0):
    """Two triangles across the z axis."""
    s = side / 2
    corners = np.array([(-s, -s, z), (s, -s, z), (s, s, z), (-s, s, z)], np.float32)
    return Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32))


def still_life():
    """A floor, a turned box, a smooth and coloured roof, two spheres one inside the other."""
    floor = Mesh([(-9, -1, -9), (9, -1, -9), (9, -1, 9), (-9, -1, 9)], [[0, 1, 2], [0, 2, 3]])
    turned = np.eye(4)
    turned[:3] = [[0.4, -0.3, 0, -1.2], [0.3, 0.4, 0, 0], [0, 0, 0.5, -0.6]]
    roof = triangle(
        (0.4, -0.8, -1),
        (2, -0.6, 0.2),
        (1, 0.9, -0.4),
        normals=np.array([(0, 0, 1), (0.8, 0, 0.6), (0, 0.6, 0.8)], np.float32),
        colors=np.array([(1, 0, 0), (0, 1, 0), (0.2, 0.4, 1)], np.float32),
    )
    return Scene(
        (
            SceneObject(floor, replace(CHECKERED, checker=Checker((0, 0, 0), 1.0))),
            SceneObject(replace(shapes.box(2.0), transform=turned), CHECKERED),
            SceneObject(roof, Material((0.8, 0.8, 0.8), (0.3, 0.3, 0.3), 20)),
            SceneObject(Sphere((0.2, -0.3, 0.6), 0.7), CHECKERED),
            SceneObject(Sphere((0.2, -0.3, 0.6), 0.3), Material((0.9, 0.1, 0.1))),
        ),
        (PointLight((3, 4, 5)), DirectionalLight((1, -2, -0.5), (0.4, 0.5, 0.6))),
        background=(0.1, 0.2, 0.3),
    )


def agrees(rasterizer, scene, camera, size=(32, 24)):
    """Draws, and compares with float64: no pixel may differ without a line of the image near it.
    Returns the frame."""
    rasterizer.set_scene(scene)
    frame = rasterizer.render(camera, size, CHANNELS)
    result = compare_frames(flatten(scene), camera, size, frame, reference(scene, camera, size))
    assert result.unexplained == 0, result.summary()
    return frame


SKEWED = {"u": (1, 0.2, 0), "v": (-0.3, 0.8, 0.1), "w": (0.2, 0.1, 1.3)}
CAMERAS = {
    "canonical": replace(WIDE, eye=(0, 0, 5)),
    "from above": Camera.look_at((4, 5, 6), (0, 0, 0), fov_y_deg=35, aspect=4 / 3),
    "skewed": replace(WIDE, eye=(0.8, 0.3, 5), **SKEWED),
    "left-handed": replace(WIDE, eye=(0, 0.5, 5), u=(-1, 0, 0)),
    "left-handed, skewed, scaled": Camera((1, 0.5, 6), (0.1, 9, 0), (7, 0.2, 1), (0.3, 0.1, 0.4)),
    "off-axis": replace(WIDE, eye=(3, 0, 5), viewport=(-1.2, 0.1, -0.2, 0.5)),
    "inside a sphere": Camera.look_at((0.25, -0.3, 0.2), (0.5, 0, 0), fov_y_deg=100),
    "inside two spheres": Camera.look_at((0.25, -0.3, 0.7), (0.5, 0, 0), fov_y_deg=100),
    "inside the box": Camera.look_at((-1.2, 0.1, -0.6), (0, 0, 0.3), fov_y_deg=110),
    "close to the floor": Camera.look_at((2, -0.998, 3), (0, -0.99, 0), fov_y_deg=50),
    "close to a sphere": Camera.look_at((0.2, -0.3, 1.3005), (0.4, -0.2, 0), fov_y_deg=90),
    "telephoto": Camera.look_at((90, 120, 260), (0, -0.3, 0), fov_y_deg=1),
    "along the floor": replace(WIDE, eye=(0, -1, 5)),
}
