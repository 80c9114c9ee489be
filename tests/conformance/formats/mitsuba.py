"""Mitsuba 3: its sensor's sample_ray() for our cameras; its depth and colours of scenes that we
export.

Its numbers are float32. Rays are Mitsuba's to make, so a ray of its is turned round: a point on it
is seen by our camera at the pixel that was asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import Floats
from renderer.camera_formats import PosedCamera, written
from renderer.scene import flatten, load_scene
from renderer.scene.model import DirectionalLight, Material, Mesh, Scene, SceneObject
from renderer.scene.texture import Texture
from renderer.scene_export import export_scene
from renderer.trace import Tracer
from tests.conformance.cameras import FARTHEST, NEAREST, POINTS, any_size, pixels
from tests.conformance.float32 import UNIT, point_bounds
from tests.conformance.measured import Checked, Job, Measured, measured, needed
from tests.support.format_cameras import straight_camera

# Roundings of sample_ray(): sensors/perspective.cpp and orthographic.cpp.
IN_SPACE = {
    "to_world, and the eye, stored": 2,
    "the direction's length: three squares, two sums, a root, a division": 7,
    "turned into the world: three products and two sums": 5,
    "the origin moved to the near plane": 2,
}
IN_PICTURE = {
    "the place in the picture, stored": 1,
    "sample_to_camera: five matrices, multiplied": 4 * 7,
    "their numbers: the tangent of fov, principal point, aspect ratio, clip planes": 6,
    "times the place: four products and three sums, a division": 8,
}
# Of a hit: Mitsuba's and our tracer's ways together.
OF_A_HIT = {
    "Mitsuba's vertices: stored, times to_world": 8,
    "its ray": sum(IN_SPACE.values()),
    "its triangle: two edges, two cross products, three scalar products, a division": 20,
    "the point between the vertices: three products and two sums": 5,
    "our vertices and our ray, stored": 4,
    "our triangle, as above": 20,
}
SCENES = ("still-life", "spheres", "primitives")  # columns are too thin for pictures so small
CAMERAS = 8  # a scene
SIZE = (96, 54)
# Of the mean colour where something is hit, with shadows on.
MATT, SHINY = 0.01, 0.05
SUNS = (
    DirectionalLight((-1, -2, -1.5), (0.9, 0.8, 0.7)),
    DirectionalLight((2, -1, -0.5), (0.2, 0.3, 0.4)),
)
FAR_AS_EYES = 5.0  # the random cameras' spread


def check(job: Job) -> Checked:
    mitsuba = needed("mitsuba")
    mitsuba.set_variant("scalar_rgb")
    return Checked(
        f"Mitsuba {mitsuba.__version__}: `sample_ray`, its depth and colours of exports",
        (_rays(mitsuba, job), *_depths(mitsuba, job), *_colours(mitsuba, job)),
    )


def _rays(mitsuba: Any, job: Job) -> Measured:
    random, errors, bounds = job.random, [], []
    for number in range(job.cameras):
        size = any_size(random)
        camera = _square(_any_camera(random, parallel=number % 3 == 0), size)
        (sensor,) = mitsuba.load_string(_file(camera, size)).sensors()
        if tuple(sensor.film().size()) != size:
            raise AssertionError("another size")
        where, points = random.uniform(0, 1, (POINTS, 2)), []
        for place in where.tolist():
            ray, _ = sensor.sample_ray(0.0, 0.5, place, [0.5, 0.5])
            # About as far away as the eye is from the origin: nearer, the eye's rounding is all.
            distance = FAR_AS_EYES * random.uniform(NEAREST, FARTHEST)
            points.append(np.array(ray.o, float) + distance * np.array(ray.d, float))
        errors.append(pixels(camera, np.array(points), size) - where * size)
        bounds.append(point_bounds(camera, size, np.array(points), IN_SPACE, IN_PICTURE))
    return measured("rays of our sensors", errors, bounds)


def _file(camera: Camera, size: Size) -> str:
    return written([PosedCamera(camera, size)], "mitsuba")[""].decode()


def _any_camera(random: np.random.Generator, parallel: bool) -> Camera:
    """Off-axis; parallel rays with any basis, of either hand."""
    camera = straight_camera(random, "parallel" if parallel else "perspective")
    if not parallel:
        return camera
    u, v, w = (np.asarray(axis) for axis in (camera.u, camera.v, camera.w))
    side = random.choice([-1, 1])
    return replace(camera, u=side * (u + 0.3 * v), w=w + 0.3 * np.linalg.norm(w) * u)


def _square(camera: Camera, size: Size) -> Camera:
    """With square pixels, which Mitsuba's perspective has only."""
    if camera.is_parallel:
        return camera
    left, right, bottom, _ = camera.viewport
    pixel = (right - left) * np.linalg.norm(camera.u) / size[0]
    top = bottom + pixel * size[1] / np.linalg.norm(camera.v)
    return replace(camera, viewport=(left, right, bottom, float(top)))


class Pictures(NamedTuple):
    """The pictures of one scene and camera: our tracer's, and Mitsuba's hits at the pixels'
    centres, NaN for none, with the objects' numbers, -1 for none.
    """

    depth: Floats
    objects: np.ndarray
    normal: Floats
    point: Floats
    their_objects: np.ndarray


def _depths(mitsuba: Any, job: Job) -> tuple[Measured, Measured]:
    """The depth where both hit the same object, and pixels that hit another one, edges left out."""
    errors, bounds, others, count = [np.zeros(0)], [np.zeros(0)], [], 0
    for camera, pictures in _pictures(mitsuba, job):
        inside = ~_edges(pictures)
        others.append(int((inside & (pictures.objects != pictures.their_objects)).sum()))
        same = inside & (pictures.objects >= 0) & (pictures.objects == pictures.their_objects)
        if not same.any():
            raise AssertionError("a picture shows nothing")
        ray = camera.rays(SIZE)
        square = (ray.direction**2).sum(-1)
        t = ((pictures.point - ray.origin) * ray.direction).sum(-1) / square
        errors.append((np.abs(t - pictures.depth) / pictures.depth)[same])
        # First order: what moves the hit by 1 moves it along the ray by 1 over the cosine.
        length = np.sqrt(square)
        cosine = np.abs((ray.direction * pictures.normal).sum(-1)) / length
        moved = np.linalg.norm(pictures.point, axis=-1) + np.linalg.norm(ray.origin, axis=-1)
        allowed = sum(OF_A_HIT.values()) * UNIT * moved[same]
        bounds.append(allowed / cosine[same] / length[same] / pictures.depth[same])
        count += 1
    return (
        measured(
            f"depth of {len(SCENES)} scenes, {SIZE[0]} x {SIZE[1]} pixels, edges left out",
            np.concatenate(errors),
            np.concatenate(bounds),
            cameras=count,
            unit="of the depth",
        ),
        measured("objects there", others, 0.0, unit="pixels with another object"),
    )


def _pictures(mitsuba: Any, job: Job) -> Iterator[tuple[Camera, Pictures]]:
    random, path = job.random, job.folder / "scene.xml"
    for name in SCENES:
        scene = load_scene(name)
        with Tracer(scene, threads=1) as tracer:
            for number in range(CAMERAS):
                camera = _looking_at(scene, random, parallel=number % 2 == 1)
                export_scene(path, scene, camera, SIZE)
                frame = tracer.render(camera, SIZE, ("depth", "id", "normal"))
                hits = _hits(mitsuba, path)
                yield camera, Pictures(frame.depth, frame.id, frame.normal, *hits)


def _colours(mitsuba: Any, job: Job) -> Iterator[Measured]:
    """The mean colours of SCENES under suns, with matt, shiny and patterned materials."""
    texels = job.random.integers(0, 256, (8, 16, 3)).astype(np.uint8)
    looks = {
        "matt": (Material(), MATT),
        "textured": (Material((0.9, 0.7, 0.5), texture=Texture(texels)), MATT),
        "shiny": (Material((0.6, 0.3, 0.1), (0.5, 0.4, 0.3), 30), SHINY),
        "metallic": (Material((0.1, 0.1, 0.1), (0.9, 0.8, 0.6), 3), SHINY),
    }
    path = job.folder / "colours.xml"
    for look, (material, bound) in looks.items():
        errors = []
        for name in SCENES:
            scene = load_scene(name)
            objects = tuple(_made_of(material, entry) for entry in scene.objects)
            scene = replace(scene, objects=objects, lights=SUNS)
            assert scene.view is not None
            camera = scene.view.for_size(SIZE)
            export_scene(path, scene, camera, SIZE)
            theirs = np.array(mitsuba.render(mitsuba.load_file(str(path))))
            with Tracer(scene, threads=1, shadows=True) as tracer:
                frame = tracer.render(camera, SIZE, ("color", "id"), samples=16)
            hit = frame.id >= 0
            errors.append(theirs[hit].mean(axis=0) / frame.color[hit].mean(axis=0) - 1)
        what = f"mean colours of {len(SCENES)} {look} scenes, with shadows"
        yield measured(what, errors, bound, unit="of the mean colour")


def _made_of(material: Material, entry: SceneObject) -> SceneObject:
    if isinstance(entry.shape, Mesh) and entry.shape.uv is None:
        material = replace(material, texture=None)
    return replace(entry, material=material)


def _looking_at(scene: Scene, random: np.random.Generator, parallel: bool) -> Camera:
    low, high = flatten(scene).bounds
    middle, radius = (low + high) / 2, min(float(np.linalg.norm(high - low)) / 2, 30.0)
    back = random.normal(size=3)
    back[1] = 0.5 * abs(back[1])
    back /= np.linalg.norm(back)
    eye = middle + radius * random.uniform(0.8, 2) * back
    target = middle + 0.1 * radius * random.normal(size=3)
    camera = Camera.look_at(eye, target, random.normal(size=3), fov_y_deg=random.uniform(15, 80))
    x, y = random.uniform(-0.2, 0.2, 2)
    aspect = SIZE[0] / SIZE[1]
    viewport = np.array([x - aspect / 2, x + aspect / 2, y - 0.5, y + 0.5])
    if not parallel:
        return replace(camera, viewport=tuple(viewport))
    askance = np.asarray(camera.w) * 2 + 0.3 * np.asarray(camera.u)
    return replace(camera, projection="parallel", viewport=tuple(radius * viewport), w=askance)


def _hits(mitsuba: Any, path: Path) -> tuple[Floats, np.ndarray]:
    scene = mitsuba.load_file(str(path), optimize=False)
    (sensor,) = scene.sensors()
    width, height = SIZE
    point, number = np.full((height, width, 3), np.nan), np.full((height, width), -1)
    for i in range(height):
        for j in range(width):
            place = [(j + 0.5) / width, (i + 0.5) / height]
            ray, _ = sensor.sample_ray(0.0, 0.5, place, [0.5, 0.5])
            hit = scene.ray_intersect(ray)
            if hit.is_valid():
                point[i, j] = hit.p
                number[i, j] = int(hit.shape.id().removeprefix("object-"))
    return point, number


def _edges(pictures: Pictures) -> np.ndarray:
    """Pixels beside which another object, another face or another depth is seen; of the image, the
    outermost beside those of its other side."""
    depth, objects, normal = pictures.depth, pictures.objects, pictures.normal
    edge = np.zeros(objects.shape, bool)
    for move in ((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)):
        edge |= np.roll(objects, move, (0, 1)) != objects
        with np.errstate(invalid="ignore"):
            edge |= np.abs(np.roll(depth, move, (0, 1)) - depth) > 0.05 * depth
        edge |= (objects >= 0) & ((np.roll(normal, move, (0, 1)) * normal).sum(-1) < 0.9)
    return edge
