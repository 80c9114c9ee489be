"""Random scenes, and random cameras that look at them.

Owns what a legal scene and a legal camera may be at their oddest: all shapes, scaled by very
different factors, spheres within spheres; skewed, left-handed, tiny and huge views from within,
from the surfaces and from very far away. Knows nothing of renderers.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lucida import Camera
from lucida.renderer.camera.lenses import MODELS, Lens
from lucida.renderer.scene import shapes
from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    Checker,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Shape,
    Sphere,
)
from lucida.renderer.scene.positions import world_corners

Random = np.random.Generator

# What a view tries, and how often.
KINDS = {
    "any": 0.34,
    "far": 0.16,
    "near surface": 0.14,
    "on surface": 0.08,
    "tiny": 0.14,
    "huge": 0.07,
    "inside": 0.07,
}


def random_scene(rng: Random, offset: float = 0.0) -> Scene:
    """One to six objects about a point that is `offset` from the origin, and one to four lights."""
    middle = rng.normal(size=3)
    middle *= offset / np.linalg.norm(middle)
    objects = [_random_object(rng, middle) for _ in range(rng.integers(1, 7))]
    return Scene(
        tuple(objects),
        tuple(_random_light(rng, middle) for _ in range(rng.integers(1, 5))),
        ambient=tuple(rng.uniform(0, 0.2, 3)),
        background=tuple(rng.uniform(0, 0.5, 3)),
    )


def _random_object(rng: Random, middle: np.ndarray) -> SceneObject:
    place = middle + rng.normal(size=3) * 10 ** rng.uniform(-1, 0.5)
    shape: Shape
    if rng.random() < 0.3:  # spheres are few in numbers and often within one another
        place = middle + rng.normal(size=3) * 0.2
        shape = Sphere(tuple(place), 10 ** rng.uniform(-2.5, 1))
    else:
        mesh = _random_mesh(rng)
        size = 10 ** rng.uniform(-1, 0.5, 3) if rng.random() < 0.5 else 10 ** rng.uniform(-3, 3, 3)
        if rng.random() < 0.3:
            size = np.full(3, size[0])
        turn = rng.uniform(-180, 180, 3) if rng.random() < 0.7 else np.zeros(3)
        size = size * rng.choice([-1.0, 1.0], 3, p=[0.2, 0.8])
        shape = shapes.transformed(mesh, shapes.placement(place, turn, tuple(size)))
    return SceneObject(shape, _random_material(rng))


def _random_mesh(rng: Random) -> Mesh:
    segments, smooth = int(rng.integers(3, 40)), bool(rng.random() < 0.7)
    sides = int(rng.integers(3, 24))
    kind = rng.integers(8)
    if kind < 6:
        return (
            lambda: shapes.box(tuple(rng.uniform(0.2, 2, 3))),
            lambda: shapes.rectangle(*rng.uniform(0.2, 3, 2)),
            lambda: shapes.disk(rng.uniform(0.2, 2), segments),
            lambda: shapes.cylinder(*rng.uniform(0.2, 2, 2), segments, smooth),
            lambda: shapes.cone(*rng.uniform(0.2, 2, 2), segments, smooth),
            lambda: shapes.torus(1, rng.uniform(0.1, 0.8), segments, sides, smooth),
        )[kind]()
    return shards(rng, int(rng.integers(1, 40)), kind == 6, bool(rng.random() < 0.5))


def shards(rng: Random, count: int, smooth: bool, colored: bool) -> Mesh:
    """Triangles here and there, with any normals at their vertices, or none."""
    corners = rng.uniform(-1, 1, (count, 1, 3)) + rng.normal(scale=0.4, size=(count, 3, 3))
    normals = rng.normal(size=(3 * count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Mesh(
        corners.reshape(-1, 3),
        np.arange(3 * count).reshape(-1, 3),
        normals if smooth else None,
        rng.uniform(0, 1, (3 * count, 3)) if colored else None,
    )


def _random_material(rng: Random) -> Material:
    shiny = rng.random() < 0.4
    checker = Checker(tuple(rng.uniform(0, 1, 3)), 10 ** rng.uniform(-1.5, 0.5))
    return Material(
        tuple(rng.uniform(0, 1, 3)),
        tuple(rng.uniform(0, 1, 3)) if shiny else (0.0, 0.0, 0.0),
        10 ** rng.uniform(0, 3),
        checker if rng.random() < 0.5 else None,
    )


def _random_light(rng: Random, middle: np.ndarray) -> PointLight | DirectionalLight:
    color = tuple(rng.uniform(0, 1, 3))
    if rng.random() < 0.5:
        return DirectionalLight(tuple(rng.normal(size=3)), color)
    return PointLight(tuple(middle + rng.normal(size=3) * 10 ** rng.uniform(-1, 1.5)), color)


def random_view(rng: Random, flat: FlatScene) -> tuple[str, Camera]:
    """Return the view's kind, one of KINDS, and a camera."""
    kind = str(rng.choice(list(KINDS), p=list(KINDS.values())))
    primitive = int(rng.integers(len(flat.faces) + len(flat.spheres)))
    bounds = flat.bounds if rng.random() < 0.3 else bounds_of_object(flat, primitive)
    camera = random_camera(rng, bounds)
    reach = np.linalg.norm(bounds[1].astype(float) - bounds[0])
    if kind == "far":
        camera = _far_away(rng, camera, bounds.astype(float), reach)
    elif kind in ("near surface", "on surface"):
        point, normal = random_point(rng, flat, primitive)
        away = rng.choice([-1, 1]) * reach * 10 ** rng.uniform(-7, -1)
        away = 0.0 if kind == "on surface" else away
        camera = replace(camera, eye=tuple(point + away * normal))
    elif kind == "inside":
        camera = replace(camera, eye=tuple(bounds.astype(float).mean(0)))
    elif kind == "tiny":
        camera = _widened(camera, 10 ** rng.uniform(-4, -1))
    elif kind == "huge":
        camera = _widened(camera, 10 ** rng.uniform(0.5, 3))
    if rng.random() < 0.2:
        camera = _cut(rng, camera, bounds.astype(float))
    return kind, camera


def random_camera(rng: Random, bounds: np.ndarray) -> Camera:
    """Any camera that sees something of the box `bounds` (2, 3): skewed, left-handed, off-axis,
    near objects and inside them, telephoto, parallel."""
    low, high = bounds.astype(float)
    reach = np.linalg.norm(high - low)
    target = rng.uniform(low, high)
    if rng.random() < 0.4:  # among the objects or inside one
        eye = rng.uniform(low, high)
    else:
        away = rng.normal(size=3)
        eye = target + away / np.linalg.norm(away) * reach * 10 ** rng.uniform(-1.5, 1)
    back = eye - target
    far_off = np.linalg.norm(back)
    camera = Camera.look_at(eye, target, rng.normal(size=3))
    basis = camera.basis
    if rng.random() < 0.6:  # skewed: but w still looks about where it looked
        basis = basis + rng.normal(size=(3, 3)) * [0.4, 0.4, 0.1]
    if rng.random() < 0.3:
        basis[:, rng.integers(2)] *= -1
    if rng.random() < 0.5:
        basis = basis * 10 ** rng.uniform(-1, 1, 3)
    if rng.random() < 0.15:  # along the axes: rays parallel to the boxes' sides
        basis = np.eye(3)[rng.permutation(3)] * rng.choice([-1.0, 1.0], 3)
    lengths = np.linalg.norm(basis, axis=0)
    if abs(np.linalg.det(basis / lengths)) < 0.05:
        return random_camera(rng, bounds)
    projection = ("perspective", "parallel")[rng.integers(2)]
    distance = 10 ** rng.uniform(-0.7, 0.7)
    if projection == "parallel":
        half = rng.uniform(0.05, 0.6) * reach / lengths[:2]
    else:
        angle = 10 ** rng.uniform(-1.3, 0.2) if far_off < reach else reach / far_off
        half = angle * rng.uniform(0.2, 1) * distance * lengths[2] / lengths[:2]
    shift = rng.uniform(-0.8, 0.8, 2) * half
    return Camera(
        tuple(eye),
        *(tuple(vector) for vector in basis.T),
        distance,
        (shift[0] - half[0], shift[0] + half[0], shift[1] - half[1], shift[1] + half[1]),
        projection,
    )


def random_lens(rng: Random, camera: Camera) -> Camera:
    """The camera with any lens, in perspective; its viewport as it was, or as wide as the lens."""
    model = str(rng.choice(list(MODELS)))
    largest = {"k1": 0.2, "k2": 0.1, "p1": 0.02, "p2": 0.02}
    coefficients = {
        name: float(rng.uniform(0.3, 1.5) if name == "omega" else rng.normal())
        * (1.0 if name == "omega" else largest.get(name, 0.01))
        for name in MODELS[model]
        if rng.random() < 0.7 or name == "omega"
    }
    camera = replace(camera, projection="perspective", lens=Lens(model, coefficients))
    if rng.random() < 0.3:
        return camera
    left, right, bottom, top = camera.viewport
    half = camera.distance * (0.9 if model == "brown" else 1.8) * 10 ** rng.uniform(-0.5, 0.3)
    return _widened(camera, half / max(right - left, top - bottom))


def random_point(rng: Random, flat: FlatScene, primitive: int) -> tuple[np.ndarray, np.ndarray]:
    """A point of a primitive (a corner, on an edge, or anywhere), and its unit normal; float64."""
    if primitive >= len(flat.faces):
        sphere = flat.spheres[primitive - len(flat.faces)].astype(float)
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        return sphere[:3] + sphere[3] * normal, normal
    corners = world_corners(flat, np.array([primitive]))[0]
    weights = rng.dirichlet(np.ones(3)) if rng.random() < 0.8 else np.eye(3)[rng.integers(3)]
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    size = np.linalg.norm(normal)
    return weights @ corners, normal / size if size > 0 else np.array([0.0, 1.0, 0.0])


def bounds_of_object(flat: FlatScene, primitive: int) -> np.ndarray:
    """The box (2, 3) around the object that a primitive belongs to."""
    if primitive >= len(flat.faces):
        center, radius = np.split(flat.spheres[primitive - len(flat.faces)], [3])
        return np.stack([center - radius, center + radius])
    first, count = flat.object_faces[flat.face_object[primitive]]
    corners = world_corners(flat, np.arange(first, first + count)).reshape(-1, 3)
    return np.stack([corners.min(0), corners.max(0)])


def _far_away(rng: Random, camera: Camera, bounds: np.ndarray, reach: float) -> Camera:
    """The camera drawn back along w, its viewport narrower by about as much, or by less."""
    w = np.array(camera.w)
    length = np.linalg.norm(w)
    back = reach * 10 ** rng.uniform(1, 6)
    eye = bounds.mean(0) + w / length * back + rng.normal(size=3) * 0.2 * reach
    camera = replace(camera, eye=tuple(eye))
    wide = 10 ** rng.uniform(0, 6) if rng.random() < 0.4 else 1.0  # the object less than a pixel
    if camera.is_parallel:
        return _widened(camera, wide)
    half = wide * reach / back * camera.distance * length * rng.uniform(0.2, 1)
    sizes = half / np.linalg.norm(camera.u), half / np.linalg.norm(camera.v)
    x, y = sizes * rng.uniform(-0.9, 0.9, 2)
    return replace(camera, viewport=(x - sizes[0], x + sizes[0], y - sizes[1], y + sizes[1]))


def _widened(camera: Camera, factor: float) -> Camera:
    """The viewport larger about the image of what the camera looks at."""
    left, right, bottom, top = camera.viewport
    x, y = (left + right) / 2, (bottom + top) / 2
    return replace(
        camera,
        viewport=(
            x + factor * (left - x), x + factor * (right - x),
            y + factor * (bottom - y), y + factor * (top - y),
        ),
    )  # fmt: skip


def _cut(rng: Random, camera: Camera, bounds: np.ndarray) -> Camera:
    """Near, far, or both, set to where they cut the box."""
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8)
    along = -(camera.camera_from_world[2, :3] @ corners + camera.camera_from_world[2, 3])
    low, high = max(along.min(), 0.0), max(along.max(), 1e-6)
    near, far = np.sort(rng.uniform(low, high, 2))
    return replace(
        camera,
        near=max(near, 1e-9) if rng.random() < 0.7 else None,
        far=max(far, near * 1.001, 2e-9) if rng.random() < 0.7 else None,
    )
