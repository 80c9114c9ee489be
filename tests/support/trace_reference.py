"""Compute what renderers must, again: in NumPy and float64, without a BVH; and cast rays.

The formulas differ from the kernel's where they can: Möller and Trumbore for triangles, the plain
quadratic for spheres.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.flat import FlatScene, flatten
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
from lucida.renderer.scene.positions import world_vertices
from lucida.renderer.trace.bvh.binary import tree_of_scene
from lucida.renderer.trace.compile.compiled import kernel
from lucida.renderer.trace.reference.kernel import viewing_ray
from lucida.renderer.trace.reference.traverse import Tree, closest_hit
from lucida.renderer.trace.threads.thread_pool import Team

LIGHTS = (PointLight((4, 5, 3), (0.8, 0.7, 0.6)), DirectionalLight((-1, -2, -1), (0.3, 0.3, 0.5)))


class Hits(NamedTuple):
    """The hits of n rays. doubtful: within 1e-9 of an edge, a silhouette or an equally near hit."""

    t: np.ndarray
    primitive: np.ndarray
    b1: np.ndarray
    b2: np.ndarray
    doubtful: np.ndarray


def scene_of(*shapes: Shape, material: Material | None = None) -> Scene:
    """A lit scene of these shapes."""
    objects = tuple(SceneObject(shape, material or Material()) for shape in shapes)
    return Scene(objects, LIGHTS, background=(0.1, 0.2, 0.3))


def closest(flat: FlatScene, origins: np.ndarray, directions: np.ndarray, t_range=(0.0, np.inf)):
    """The closest hits of rays (n, 3), by trying every primitive."""
    t_min, t_max = t_range
    n = len(origins)
    best, second = np.full(n, np.inf), np.full(n, np.inf)
    primitive, b1, b2 = np.full(n, -1), np.zeros(n), np.zeros(n)
    doubtful = np.zeros(n, bool)
    vertices = world_vertices(flat)
    for number, (i, j, k) in enumerate(flat.faces):
        a, e1, e2 = vertices[i], vertices[j] - vertices[i], vertices[k] - vertices[i]
        if not np.cross(e1, e2).any():
            continue
        p = np.cross(directions, e2)
        with np.errstate(all="ignore"):
            inverse = 1 / (p @ e1)
            s = origins - a
            u = np.einsum("ij,ij->i", s, p) * inverse
            q = np.cross(s, e1)
            v = np.einsum("ij,ij->i", q, directions) * inverse
            t = (q @ e2) * inverse
            margin = np.minimum(np.minimum(u, v), 1 - u - v)
            hit = (margin >= 0) & (t > t_min) & (t < t_max)
            doubtful |= (np.abs(margin) < 1e-9) | ~np.isfinite(inverse)
        closer = hit & (t < best)
        second = np.where(closer, best, np.where(hit, np.minimum(second, t), second))
        best, primitive = np.where(closer, t, best), np.where(closer, number, primitive)
        b1, b2 = np.where(closer, u, b1), np.where(closer, v, b2)
    for number, (x, y, z, radius) in enumerate(flat.spheres, len(flat.faces)):
        f = origins - (x, y, z)
        a = np.einsum("ij,ij->i", directions, directions)
        b = np.einsum("ij,ij->i", directions, f)
        c = np.einsum("ij,ij->i", f, f) - radius**2
        discriminant = b * b - a * c
        doubtful |= np.abs(discriminant) < 1e-9 * b * b
        root = np.sqrt(np.maximum(discriminant, 0))
        for t in ((-b - root) / a, (-b + root) / a):
            hit = (discriminant >= 0) & (t > t_min) & (t < t_max)
            closer = hit & (t < best)
            second = np.where(closer, best, np.where(hit, np.minimum(second, t), second))
            best, primitive = np.where(closer, t, best), np.where(closer, number, primitive)
            b1, b2 = np.where(closer, 0, b1), np.where(closer, 0, b2)
    with np.errstate(invalid="ignore"):
        doubtful |= second - best <= 1e-9 * np.abs(best)
    return Hits(best, primitive, b1, b2, doubtful)


def shaded(scene: Scene, flat: FlatScene, camera: Camera, size: tuple[int, int], hits: Hits):
    """(color, normal), each (height, width, 3), of the hits of an image's rays, pixel by pixel."""
    width, height = size
    color = np.empty((height, width, 3))
    normal = np.zeros((height, width, 3))
    color[:] = scene.background
    rays = camera.rays(size)
    for pixel in np.ndindex(height, width):
        at = pixel[0] * width + pixel[1]
        if hits.primitive[at] < 0:
            continue
        color[pixel], normal[pixel] = _shaded_hit(
            flat, rays.origin[pixel], rays.direction[pixel], *(part[at] for part in hits[:4])
        )
    return color, normal


def reference(scene: Scene, camera: Camera, size: tuple[int, int]) -> Frame:
    """A frame with every channel."""
    flat, rays = flatten(scene), camera.rays(size)
    origins = np.broadcast_to(rays.origin, rays.direction.shape).reshape(-1, 3)
    hits = closest(flat, origins, rays.direction.reshape(-1, 3), camera.t_range)
    color, normal = shaded(scene, flat, camera, size, hits)
    owners = np.concatenate([flat.face_object, flat.sphere_object, [-1]]).astype(np.int32)
    t, primitive = (part.reshape(size[::-1]) for part in (hits.t, hits.primitive))
    return Frame(
        size,
        color.astype(np.float32),
        t.astype(np.float32),
        normal.astype(np.float32),
        owners[primitive],
        primitive.astype(np.int32),
    )


def _length(vector):
    return math.sqrt(vector @ vector)  # np.linalg.norm takes three times as long


def _unit(vector):
    return vector / _length(vector)


def _cross(a, b):
    (x, y, z), (u, v, w) = a.tolist(), b.tolist()
    return np.array([y * w - z * v, z * u - x * w, x * v - y * u])


def _shaded_hit(flat: FlatScene, origin, direction, t, primitive, b1, b2):
    point, along = origin + t * direction, _unit(direction)
    tint = np.ones(3)
    if primitive < len(flat.faces):
        owner = flat.face_object[primitive]
        corners = flat.faces[primitive]
        a, b, c = flat.vertices[corners].astype(float) @ flat.world_from_object[owner, :3, :3].T
        weights = np.array([1 - b1 - b2, b1, b2])
        g = _unit(_cross(b - a, c - a))
        tint = weights @ flat.colors[corners].astype(float)
        normals = flat.normals[corners].astype(float)
    else:
        sphere = flat.spheres[primitive - len(flat.faces)]
        owner = flat.sphere_object[primitive - len(flat.faces)]
        g, normals = _unit(point - sphere[:3]), np.zeros((3, 3))
    side = 1 if g @ direction < 0 else -1
    n = side * g
    if normals.any(axis=1).all():
        smooth = weights @ normals
        if _length(smooth) >= 1e-6:
            n = _unit(smooth) * side * (1 if normals.sum(axis=0) @ g >= -1e-5 else -1)
    cosine = n @ along
    if cosine > -1e-3:
        n = _unit(n - (cosine + 1e-3) * along)

    material = flat.materials[owner].astype(float)
    albedo = material[0, :3]
    linear = flat.cells[owner, :, :3]
    cell = linear @ point + flat.cells[owner, :, 3] - 1e-3 * _unit(linear @ (side * g))
    if material[1, 3] and np.floor(cell).sum() % 2:
        albedo = material[2, :3]
    albedo = albedo * tint
    color = flat.ambient * albedo
    for place, rgb in flat.lights:
        light = place[:3] - point if place[3] else place[:3]
        if _length(light) < 1e-12:
            continue
        light = _unit(light)
        half = light - along
        is_bright = _length(half) >= 1e-6
        highlight = max(0.0, n @ _unit(half)) ** material[0, 3] if is_bright else 0.0
        color = color + rgb[:3] * (albedo * max(0.0, n @ light) + material[1, :3] * highlight)
    return color, n


def tree_of(flat: FlatScene, leaf_size: int = 4) -> Tree:
    team = Team(1)
    return tree_of_scene(flat, team, leaf_size)


def cast(tree, origins, directions, t_min, t_max):
    """(t, primitive, b1, b2) of rays (n, 3)."""
    rays = (np.array(part, float, order="C") for part in (origins, directions))  # of one type
    return _cast(tree, *rays, t_min, t_max)


@kernel
def _cast(tree, origins, directions, t_min, t_max):
    n = len(origins)
    t, b1, b2 = np.empty(n), np.empty(n), np.empty(n)
    primitive = np.empty(n, np.int64)
    stack = np.empty(tree.stack_size, np.int32), np.empty(tree.stack_size)
    for i in range(n):
        o = origins[i, 0], origins[i, 1], origins[i, 2]
        d = directions[i, 0], directions[i, 1], directions[i, 2]
        t[i], primitive[i], b1[i], b2[i] = closest_hit(tree, stack, o, d, t_min, t_max)
    return t, primitive, b1, b2


@kernel
def kernel_rays(view, width, height):
    """The kernel's rays of an image: origins and directions (height, width, 3)."""
    rays = np.empty((2, height, width, 3))
    for i in range(height):
        for j in range(width):
            origin, direction = viewing_ray(view, i, j, width, height)
            for k in range(3):
                rays[0, i, j, k], rays[1, i, j, k] = origin[k], direction[k]
    return rays


def random_basis(random: np.random.Generator) -> np.ndarray:
    """Three vectors, skewed, of different lengths, left- or right-handed, not nearly dependent."""
    while True:
        basis = random.normal(size=(3, 3)) * random.uniform(0.3, 3, size=(3, 1))
        if abs(np.linalg.det(basis / np.linalg.norm(basis, axis=1, keepdims=True))) > 0.1:
            return basis


def random_camera(random: np.random.Generator, near_far: bool = False) -> Camera:
    """A camera near the origin, off-axis, of either projection."""
    u, v, w = random_basis(random).tolist()
    left, bottom = random.uniform(-1.5, 0.5, size=2)
    width, height = random.uniform(0.3, 2, size=2)
    near, far = (0.5, 4.0) if near_far else (None, None)
    return Camera(
        tuple(random.normal(size=3) * 2),
        u,
        v,
        w,
        float(random.uniform(0.3, 3)),
        (left, left + width, bottom, bottom + height),
        str(random.choice(["perspective", "parallel"])),
        near,
        far,
    )


def random_scene(random: np.random.Generator, triangles: int = 40, spheres: int = 6) -> Scene:
    """Triangles with vertex colours, some with normals, and spheres about the origin."""
    checker = Material((0.6, 0.5, 0.4), (0.3, 0.3, 0.3), 20, Checker((0.1, 0.2, 0.3), 0.37))
    shapes = []
    for flat in (True, False):
        corners = random.normal(size=(triangles // 2, 1, 3)) * 2 + random.normal(
            size=(triangles // 2, 3, 3)
        )
        vertices = corners.reshape(-1, 3)
        faces = np.arange(len(vertices)).reshape(-1, 3)
        normals = None if flat else random.normal(size=vertices.shape)
        if normals is not None:
            normals /= np.linalg.norm(normals, axis=1, keepdims=True)
            normals[:3] = 0
        colors = random.uniform(size=vertices.shape)
        transform = np.eye(4)
        transform[:3, :3] = random_basis(random)
        transform[:3, 3] = random.normal(size=3)
        mesh = Mesh(vertices, faces, normals, colors, transform)
        shapes.append(SceneObject(mesh, checker if flat else Material()))
    for _ in range(spheres):
        centre, radius = random.normal(size=3) * 3, random.uniform(0.1, 1.5)
        shapes.append(SceneObject(Sphere(tuple(centre), radius), checker))
    return Scene(tuple(shapes), LIGHTS, background=(0.1, 0.2, 0.3))


def ball(rows: int = 24, columns: int = 32) -> Mesh:
    """A closed mesh about the origin: a unit sphere in triangles, without a crack at the seam."""
    polar = np.linspace(0, np.pi, rows + 1)[1:-1, None]
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    ring = np.stack(
        np.broadcast_arrays(
            np.sin(polar) * np.cos(around), np.cos(polar), np.sin(polar) * np.sin(around)
        ),
        axis=-1,
    ).reshape(-1, 3)
    vertices = np.concatenate([ring, [[0, 1, 0], [0, -1, 0]]])
    top, bottom = len(ring), len(ring) + 1
    faces = []
    for j in range(columns):
        k = (j + 1) % columns
        faces += [(top, k, j), (bottom, len(ring) - columns + j, len(ring) - columns + k)]
        for i in range(rows - 2):
            a, b = i * columns + j, i * columns + k
            faces += [(a, b, b + columns), (a, b + columns, a + columns)]
    return Mesh(vertices, np.array(faces), vertices)
