"""Cameras written for Mitsuba and pbrt: their own formulas send the same rays."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from renderer.camera import Camera
from renderer.camera_formats import PosedCamera, written
from renderer.camera_formats.given import Options
from renderer.camera_formats.mitsuba import sensor_lines
from renderer.errors import LucidaError

SIZE = (32, 18)


def cameras(count: int = 40) -> list[Camera]:
    """Random, off the middle, of any lengths; parallel every other."""
    rng = np.random.default_rng(7)
    found = []
    for number in range(count):
        base = Camera.look_at(rng.normal(size=3), 5 * rng.normal(size=3), rng.normal(size=3))
        x, y = rng.uniform(-1, 1, 2)
        height = rng.uniform(0.1, 3)
        width = height * SIZE[0] / SIZE[1]
        viewport = (x - width / 2, x + width / 2, y - height / 2, y + height / 2)
        scale = rng.uniform(0.2, 4)
        found.append(
            replace(
                base,
                viewport=viewport,
                distance=rng.uniform(0.2, 3),
                w=tuple(scale * np.asarray(base.w)),
                projection="parallel" if number % 2 else "perspective",
            )
        )
    return found


def same_rays(camera: Camera, origin: np.ndarray, direction: np.ndarray) -> None:
    ours = camera.rays(SIZE)
    unit = ours.direction / np.linalg.norm(ours.direction, axis=-1, keepdims=True)
    direction = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
    np.testing.assert_allclose(direction, unit, atol=1e-9)
    np.testing.assert_allclose(np.broadcast_to(origin, unit.shape), ours.origin, atol=1e-9)


def samples() -> tuple[np.ndarray, np.ndarray]:
    """Across and down an image, 0 to 1, at the pixels' centres."""
    i, j = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    return (j + 0.5) / SIZE[0], (i + 0.5) / SIZE[1]


@pytest.mark.parametrize("camera", cameras())
def test_mitsuba_s_rays(camera: Camera):
    text = written([PosedCamera(camera, SIZE)], "mitsuba")[""]
    sensor = ElementTree.fromstring(text.decode()).find("sensor")
    assert sensor is not None
    numbers = {e.get("name"): float(e.get("value") or "") for e in sensor.findall("float")}
    matrix = sensor.find("transform/matrix")
    assert matrix is not None
    to_world = np.array((matrix.get("value") or "").split(), float).reshape(4, 4)
    across, down = samples()
    aspect = SIZE[0] / SIZE[1]
    if camera.is_parallel:
        local = np.stack([1 - 2 * across, (1 - 2 * down) / aspect, 0 * across], axis=-1)
        origin = local @ to_world[:3, :3].T + to_world[:3, 3]
        same_rays(camera, origin, np.broadcast_to(to_world[:3, 2], origin.shape))
        return
    x = across + numbers["principal_point_offset_x"] - 0.5
    y = 0.5 - down - numbers["principal_point_offset_y"]
    width = 2 * math.tan(math.radians(numbers["fov"]) / 2)
    local = np.stack([-x * width, y * width / aspect, 1 + 0 * x], axis=-1)
    np.testing.assert_allclose(to_world[:3, :3].T @ to_world[:3, :3], np.eye(3), atol=1e-12)
    same_rays(camera, to_world[:3, 3], local @ to_world[:3, :3].T)


@pytest.mark.parametrize("camera", cameras())
def test_pbrt_s_rays(camera: Camera):
    rng = np.random.default_rng(3)
    skewed = replace(camera, v=tuple(np.asarray(camera.v) + 0.2 * rng.normal(size=3)))
    mirrored = replace(camera, u=tuple(-np.asarray(camera.u)))
    for subject in (camera, skewed, mirrored):
        text = written([PosedCamera(subject)], "pbrt", Options(size=SIZE))[""].decode()
        listed = dict(re.findall(r"^(\w+).*?\[ ([-\d.e ]+) \]$", text, re.MULTILINE))
        world_from_camera = np.linalg.inv(
            np.array(listed["Transform"].split(), float).reshape(4, 4).T
        )
        left, right, bottom, top = map(float, listed["Camera"].split())
        across, down = samples()
        x, y = left + across * (right - left), top - down * (top - bottom)
        linear, eye = world_from_camera[:3, :3], world_from_camera[:3, 3]
        if subject.is_parallel:
            origin = np.stack([x, y, 0 * x], axis=-1) @ linear.T + eye
            same_rays(subject, origin, np.broadcast_to(linear[:, 2], origin.shape))
        else:
            same_rays(subject, eye, np.stack([x, y, 1 + 0 * x], axis=-1) @ linear.T)


def clip_of(camera: Camera) -> tuple[float, float]:
    text = written([PosedCamera(camera, SIZE)], "mitsuba")[""].decode()
    near, far = (float(v) for v in re.findall(r'_clip" value="([^"]*)"', text))
    return near, far


def test_mitsuba_clips_where_the_camera_does():
    camera = replace(Camera.canonical().fitted(SIZE), w=(0.0, 0.0, 2.0))
    assert clip_of(replace(camera, near=0.5, far=3.0)) == (1.0, 6.0)
    for near, far in ((None, None), (None, 1e-6), (1e9, None)):
        found = clip_of(replace(camera, near=near, far=far))
        assert 0 < found[0] < found[1]
    assert clip_of(replace(camera, near=1e9))[0] == 2e9


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("farthest", [None, 31.0])
@pytest.mark.parametrize("planes", [(None, None), (0.3, 8.0), (0.3, None), (None, 8.0)])
def test_mitsuba_s_clip_planes(planes, farthest, projection):
    """The camera's, in world units; what it has not is out of the way. In a world that is larger
    they are farther, and of the same camera with longer vectors they are the same."""
    camera = Camera(
        (1, 2, 3), distance=1.6, viewport=(-1.0, 1.2, -0.5, 0.7375), projection=projection,
        near=planes[0], far=planes[1],
    )  # fmt: skip

    def written(k: float, world: float) -> tuple[float, float]:
        """With vectors k times as long, in a world so many times as large."""
        sides = [world / k * side for side in camera.viewport]
        far = None if farthest is None else world * farthest
        near_far = [None if z is None else world / k * z for z in planes]
        lines = sensor_lines(
            Camera(
                [world * x for x in camera.eye], (k, 0, 0), (0, k, 0), (0, 0, k),
                world / k * camera.distance, sides, projection, *near_far,
            ), SIZE, far,
        )  # fmt: skip
        sensor = ElementTree.fromstringlist(lines)
        assert [one.get("value") for one in sensor.findall("string")] == (
            ["x"] if projection == "perspective" else []
        )
        numbers = {e.get("name"): float(e.get("value") or "") for e in sensor.findall("float")}
        return numbers["near_clip"], numbers["far_clip"]

    near, far = written(1, 1)
    for k, world in ((3, 1), (1, 7), (0.5, 0.25)):
        assert written(k, world) == pytest.approx((near * world, far * world))
    seen = farthest or planes[1] or camera.distance
    assert near == planes[0] if planes[0] else 0 < near <= 1e-3 * seen
    assert far == planes[1] if planes[1] else far >= 1.5 * seen


def test_the_size_that_mitsuba_s_refusal_names_is_written():
    camera = Camera(viewport=(-1.0, 3.0, -0.4, 1.2))
    with pytest.raises(LucidaError, match="as wide as high") as refused:
        written([PosedCamera(camera, (50, 50))], "mitsuba")
    found = re.search(r"--size (\d+)x(\d+)", str(refused.value))
    assert found and found.groups() == ("50", "20")
    assert written([PosedCamera(camera, (50, 20))], "mitsuba")
