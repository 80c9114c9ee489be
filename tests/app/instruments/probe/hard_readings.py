"""Readings with something unusual in them: inside, cut open, smooth, hardly seen."""

from __future__ import annotations

from dataclasses import replace

from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.probe.reading import Reading
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)

FLOOR = Mesh([[-9, 0, -9], [9, 0, -9], [9, 0, 9], [-9, 0, 9]], [[0, 2, 1], [0, 3, 2]])
ROOM = Scene(
    (
        SceneObject(FLOOR, Material((0.5, 0.25, 0.5), (0.5, 0.5, 0.5)), "floor"),
        SceneObject(
            Sphere((0, 2, -4), 1), Material((1, 0.5, 0.25), (0.25, 0.5, 0.5)), "mirror ball"
        ),
    ),
    (PointLight((0, 8, 0)), DirectionalLight((0, 1, 0))),
    background=(0.125, 0.25, 0.5),
)
# From the eye, a pixel's ray goes down at 45 degrees, meets the floor at (0, 0, -2), is mirrored
# into the middle of the ball, and from there back to where it came from.
DOWN = Camera(
    (0, 2, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), 2.0, (-1, 1, -3.5, 0.5), "perspective", near=1
)
SHELL = Scene(
    (SceneObject(Sphere((0, 0, 0), 2), Material((1, 0.5, 0.25)), "shell"),),
    (PointLight((0.5, 0.5, 0.5), (4, 1, 1)), DirectionalLight((-0.25, 1, 2))),
)
SKEWED = Camera((0.5, 0, 0), (1, 0.5, 0), (-0.5, 1, 0.25), (0, 0, 2), 1.0, (-1, 1, -1, 1))
SMOOTH = Mesh(
    [[0, 0, 0], [4, 0, 0], [0, 4, 0]],
    [[0, 1, 2]],
    normals=[[0, 0, 1], [0.6, 0, 0.8], [0, 0.6, 0.8]],
)


def on_the_floor() -> Reading:
    return Probe(ROOM).at((2, 0), DOWN, (1, 4), shadows=True, mirror_depth=2)


def in_the_shell(projection: str = "perspective", **arguments) -> Reading:
    """Return a reading of a sphere that the eye is in; one light is behind the surface."""
    camera = replace(SKEWED, projection=projection, **arguments)
    return Probe(SHELL).at((3, 0), camera, (4, 4), -1.0, "linear")


def leaf(behind: bool) -> Reading:
    camera = Camera((1, 1, -2), (-1, 0, 0), (0, 1, 0), (0, 0, -1)) if behind else Camera((1, 1, 2))
    return Probe(Scene((SceneObject(SMOOTH),))).at((0, 0), camera, (1, 1), 8.0)


def grazing(scene: Scene, height: float) -> Reading:
    """Parallel rays nearly along the surface."""
    camera = Camera((0, height, 5), (1, 0, 0), (0, 1, 0), (0, 0, 1), projection="parallel")
    return Probe(scene).at((0, 0), camera, (1, 1))


SLOPE = Mesh([[-1, 0.001, -1], [1, 0.001, -1], [0, 0, 1]], [[0, 1, 2]])  # rises by half of 0.001
BALL = Scene((SceneObject(Sphere((0, 0, 0), 1)),))
ALL = {
    "the floor": on_the_floor,
    "the ball": lambda: Probe(ROOM).at((0, 0), DOWN, (1, 4), mirror_depth=2),
    "the background": lambda: Probe(Scene(())).at((0, 0), DOWN, (1, 4), mirror_depth=2),
    "near and far": lambda: in_the_shell(near=0.5, far=6),
    "parallel, far": lambda: in_the_shell("parallel", far=6),
    "parallel, near": lambda: in_the_shell("parallel", near=0.5),
    "smooth": lambda: leaf(False),
    "smooth, from behind": lambda: leaf(True),
    "along a triangle": lambda: grazing(Scene((SceneObject(SLOPE),)), 0.0004),
    "along a sphere": lambda: grazing(BALL, 1 - 1e-8),
}
