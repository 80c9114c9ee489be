"""Teaching cameras: all that a step names is in the picture, large, not edge-on, at any size."""

from __future__ import annotations

import numpy as np
import pytest

from app.images.picking import nearest_hit
from app.lecture.model import Step
from app.lecture.reading import BUILTIN, load_lecture
from app.outside.camera_diagram import Content, diagram
from app.outside.diagram import RayEnd
from app.outside.extent import end_parameter
from app.outside.options import OutsideOptions
from app.outside.screen import OutsideScreen
from app.outside.teaching import Subject, is_in_sight, subject_of, teaching_camera
from renderer.camera import Camera
from renderer.focus import scene_focus

STEPS = [step for step in load_lecture(BUILTIN).steps if "see" in step.options.get("outside", {})]
VIEWS = [(1227, 951), (640, 330), (474, 1010)]
MARGIN = 1.1, 1.2


def subject_in(step: Step) -> tuple[Subject, Camera]:
    options = OutsideOptions(**step.options["outside"])
    size = step.options.get("images", {}).get("resolution", (800, 600))
    camera, focus, marked = step.view.for_size(size), scene_focus(step.scene), None
    if step.pixel is not None and options.ray:
        ray = camera.ray(*step.pixel, size)
        marked = RayEnd(step.pixel, nearest_hit(step.scene, ray.origin, ray.direction)[0])
    items = diagram(
        Content(camera, size, options, end_parameter(camera, focus.framed), (), marked, 1)
    )
    return subject_of(items, options.see, focus.framed.reshape(-1, 8, 3)), camera


@pytest.mark.parametrize("step", STEPS, ids=lambda step: step.title)
def test_all_that_a_step_names_fits_and_no_image_plane_is_edge_on(step: Step) -> None:
    subject, camera = subject_in(step)
    for size in VIEWS:
        looking = teaching_camera(subject, step.scene, camera, size, MARGIN)
        assert looking == teaching_camera(subject, step.scene, camera, size, MARGIN)
        assert is_in_sight(subject, looking, size)
        found = OutsideScreen(looking, size).spots(subject.points)
        assert found is not None
        filled = np.ptp(found[0], axis=0) / size  # as near as it may be
        assert filled.max() > 0.7
        for area in subject.areas[:1]:
            normal = np.cross(area[1] - area[0], area[3] - area[0])
            sight = area.mean(axis=0) - looking.eye
            sine = abs(normal @ sight) / np.linalg.norm(normal) / np.linalg.norm(sight)
            assert sine > 0.4
        for start, end in subject.lines:
            way, sight = end - start, (start + end) / 2 - looking.eye
            along = abs(way @ sight) / np.linalg.norm(way) / np.linalg.norm(sight)
            assert along < 0.98
