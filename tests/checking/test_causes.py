"""The cause of a wrong angle of view, named for a fitted camera that is too wide or too narrow."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from app.checking.mistakes.ray_diagnosis import diagnose_rays
from app.checking.mistakes.ray_trial import RayCase
from renderer.camera import Camera

SIZE = (5, 4)
CAUSES: dict[str, Callable[[float], float]] = {
    "an angle in radians were in degrees": lambda half: math.tan(math.radians(half)),
    "the whole angle were half of it": lambda half: math.tan(2 * half),
    "half the angle were the whole": lambda half: math.tan(half / 2),
    "the tangent were left out": lambda half: half,
    "the tangent were upside down": lambda half: 1 / math.tan(half),
}


def diagnosed(tangent: Callable[[float], float], angles: tuple[float, ...]) -> str:
    """Diagnose cameras with these half angles upwards, whose viewports use another tangent."""
    cases, given = [], []
    for number, half in enumerate(angles):
        camera = Camera.look_at((3.0, 1.0 + number, 2.0), (0.1, 0.2, 0.3), distance=1.3)
        for made in (math.tan(half), tangent(half)):
            high = 1.3 * made
            viewport = (-high * SIZE[0] / SIZE[1], high * SIZE[0] / SIZE[1], -high, high)
            camera = replace(camera, viewport=viewport)
            if made == math.tan(half):
                asked = camera
        for pixel in np.ndindex(SIZE[1], SIZE[0]):
            cases.append(RayCase(asked, SIZE, pixel))
            given.append(camera.ray(*pixel, SIZE))
    found = diagnose_rays(cases, np.array(given), np.ones(len(cases), bool))
    assert found is not None and not found.candidates and found.camera is not None
    return " ".join(found.sentences)


@pytest.mark.parametrize("cause", CAUSES)
def test_a_cause_is_told(cause: str) -> None:
    both = diagnosed(CAUSES[cause], (0.35, 0.52))
    assert f"your view is as if {cause}" in both
    assert f"as if {cause}" in diagnosed(CAUSES[cause], (0.35,))


def test_another_width_has_no_cause() -> None:
    for angles in ((0.35,), (0.35, 0.52)):
        told = diagnosed(lambda half: 1.7 * math.tan(half), angles)
        assert "as if" not in told and "your `distance` is 0.5882 `distance`" in told
    told = diagnosed(lambda half: math.tan(half) + 0.1, (0.35, 0.52))
    assert "as if" not in told and "your `distance` is 1.02" in told and ", not 1.3" in told
