"""Small scenes for the loop stepper, and its runs over them."""

from __future__ import annotations

import numpy as np

from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.loops import image_order, rasterization
from lucida.app.instruments.stepper.model import Moment, moment_at
from lucida.app.instruments.stepper.recording import Recording
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene import shapes
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import PointLight, Scene, SceneObject, Sphere

SIZE = (20, 15)
TWO_BALLS = Scene(
    (
        SceneObject(Sphere((0, 0, -5), 2), Material((0.9, 0.1, 0.1)), "far"),
        SceneObject(Sphere((0.3, 0, -3), 0.5), Material((0.1, 0.9, 0.1)), "near"),
    ),
    (PointLight((2, 3, 1)),),
    background=(0.25, 0.5, 0.75),
)
TWO_BOXES = Scene(
    tuple(
        SceneObject(
            shapes.transformed(shapes.box((size, size, size)), shapes.placement(place)), color, name
        )
        for name, size, place, color in (
            ("far", 4.0, (0.0, 0.0, -7.0), Material((0.9, 0.1, 0.1))),
            ("near", 1.0, (0.3, 0.0, -3.0), Material((0.1, 0.9, 0.1))),
        )
    ),
    (PointLight((2, 3, 1)),),
    background=(0.25, 0.5, 0.75),
)
SCENES = {rasterization: TWO_BOXES, image_order: TWO_BALLS}


def recorded(scene: Scene, program, camera: Camera | None = None, size=SIZE) -> Recording:
    run = Recording(Model(scene), camera or Camera.canonical(), size, program)
    assert not run.truncated
    return run


def last(run: Recording) -> Moment:
    return moment_at(run, len(run) - 1)


def cameras(scene: Scene, rng: np.random.Generator):
    """The scene's own view; then random ones: perspective, parallel, skewed, clipped."""
    own = scene.view.for_size(SIZE)
    yield own
    for kind in ("perspective", "parallel", "skewed", "clipped"):
        turn = np.eye(3) + rng.normal(scale=0.08, size=(3, 3))
        basis = own.basis @ (turn if kind == "skewed" else np.linalg.qr(turn)[0])
        if kind != "skewed":
            basis *= np.sign(np.sum(basis * own.basis, axis=0))
        eye = np.array(own.eye) + rng.normal(scale=0.3, size=3)
        depth = float(np.linalg.norm(eye)) + 3
        parallel = kind == "parallel"
        viewport = tuple(3.0 * side for side in own.viewport) if parallel else own.viewport
        yield Camera(
            tuple(eye),
            *(tuple(vector) for vector in basis.T),
            own.distance,
            viewport,
            "parallel" if parallel else "perspective",
            *((0.6 * depth, 0.9 * depth) if kind == "clipped" else (None, None)),
        )
