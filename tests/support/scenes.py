"""Scenes for several rooms' tests, and the same ones elsewhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

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

ODD = np.array([0.31830988618, -0.70710678118, 0.57721566490])  # a direction along no axis


def crowd():
    """Everything at once: coloured, smooth and checkered meshes, spheres inside one another."""
    rng = np.random.default_rng(3)
    corners = rng.uniform(-1, 1, (40, 1, 3))
    shards = (corners + rng.normal(scale=0.4, size=(40, 3, 3))).reshape(-1, 3)
    normals = rng.normal(size=(120, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    faces = np.arange(120).reshape(40, 3)
    shiny = Material((0.6, 0.5, 0.4), (0.5, 0.5, 0.5), 200, Checker((0.1, 0.2, 0.9), 0.17))
    return Scene(
        (
            SceneObject(Mesh(shards, faces, colors=rng.uniform(0, 1, (120, 3))), shiny),
            SceneObject(Mesh(shards + 0.7, faces, normals=normals), Material((0.2, 0.8, 0.3))),
            SceneObject(Sphere((0.3, 0.2, -0.4), 0.9), shiny),
            SceneObject(Sphere((0.2, 0.2, -0.4), 0.3), Material(specular=(1, 1, 1), shininess=900)),
            SceneObject(Sphere((-1, 0.5, 0.8), 0.01), Material((1, 0, 0))),
        ),
        (PointLight((2, 3, 4), (0.8, 0.8, 0.7)), DirectionalLight((1, -1, -0.5), (0.4, 0.4, 0.5))),
        background=(0.1, 0.2, 0.3),
    )


def placed(mesh: Mesh, x: float, y: float, z: float, turn_deg: float = 0.0, **changes) -> Mesh:
    """A copy at a point, turned about an odd axis."""
    a = np.radians(turn_deg)
    k = ODD / np.linalg.norm(ODD)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    transform = np.eye(4)
    transform[:3, :3] += np.sin(a) * cross + (1 - np.cos(a)) * cross @ cross
    transform[:3, 3] = x, y, z
    return replace(mesh, transform=transform, **changes)


def moved(scene: Scene, by: np.ndarray) -> Scene:
    """The scene with everything of it translated."""

    def at(point):
        return tuple((np.asarray(point, float) + by).tolist())

    def shape(old):
        if isinstance(old, Sphere):
            return replace(old, center=at(old.center))
        transform = old.transform.copy()
        transform[:3, 3] += by
        return replace(old, transform=transform)

    return replace(
        scene,
        objects=tuple(replace(entry, shape=shape(entry.shape)) for entry in scene.objects),
        lights=tuple(
            replace(light, position=at(light.position)) if isinstance(light, PointLight) else light
            for light in scene.lights
        ),
    )
