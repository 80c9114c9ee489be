"""pbrt-v4: its grammar and its camera's formulas, since the program itself is not available.

Source: pbrt-v4's documentation, "pbrt-v4 Input File Format", Cameras and Transformations: Transform
lists a matrix column after column; the camera looks along +z with y up; a perspective image is at
z = 1 where fov is 90 degrees, and screenwindow is its edges.
"""

from __future__ import annotations

import math

import numpy as np

from renderer.camera_checks import Floats
from renderer.scene import load_scene
from renderer.scene_export import export_scene
from tests.conformance.cameras import cases, lens_cases
from tests.conformance.measured import Checked, Job, Measured, measured
from tests.conformance.pbrt_grammar import Directive, PbrtError, parse
from tests.support.format_cameras import skewed_camera

SCENES = ("still-life", "columns", "spheres", "primitives")


def check(job: Job) -> Checked:
    errors = [
        seen(*parse(case.file("pbrt").decode()), case.points) - case.pixels
        for case in cases(job, skewed_camera, parallel=True)
    ]
    panoramas = [
        seen(*parse(case.file("pbrt").decode()), case.points) - case.pixels
        for case in lens_cases(job, ["equirectangular"])
    ]
    peer = "pbrt-v4's grammar and formulas, written in the check: no program"
    return Checked(
        peer,
        (
            measured("our cameras, by its formulas", errors),
            measured("our panoramas, by its formulas", panoramas, beside=True),
            _scenes(job),
        ),
    )


def _scenes(job: Job) -> Measured:
    """Export whole scenes: lights, materials, textures and shapes. The grammar may refuse them."""
    missing = []
    for name in SCENES:
        scene, path = load_scene(name), job.folder / f"{name}.pbrt"
        export_scene(path, scene, scene.view.for_size((64, 36)), (64, 36))
        shapes = sum(part.name == "Shape" for part in parse(path.read_text()))
        missing.append(shapes - len(scene.objects))
    return measured("exported scenes, by its grammar", missing, 0.0, unit="objects missing")


def seen(film: Directive, transform: Directive, camera: Directive, points: Floats) -> Floats:
    """Return the pixels of points, (n, 2), from the left upper corner."""
    if (film.name, transform.name, camera.name) != ("Film", "Transform", "Camera"):
        raise PbrtError("not a film, a transform and a camera, in this order")
    camera_from_world = np.reshape(transform.numbers, (4, 4)).T
    x, y, z, _ = camera_from_world @ np.column_stack([points, np.ones(len(points))]).T
    width, height = (float(film.parameters[f"{side}resolution"][0]) for side in "xy")
    if camera.kind == "spherical":  # from its x axis by its z axis; from its y axis down
        turn, tilt = np.arctan2(z, x) % (2 * np.pi), np.arctan2(np.hypot(x, z), y)
        return np.column_stack([turn / (2 * np.pi) * width, tilt / np.pi * height])
    if camera.kind == "perspective":
        scale = z * math.tan(math.radians(float(camera.parameters["fov"][0])) / 2)
        x, y = x / scale, y / scale
    left, right, bottom, top = map(float, camera.parameters["screenwindow"])
    return np.column_stack(
        [(x - left) / (right - left) * width, (top - y) / (top - bottom) * height]
    )
