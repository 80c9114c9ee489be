"""All camera formats: cameras come back, or are refused in one line that names the remedy."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from format_cameras import (
    ASKANCE,
    LENSES,
    MIRRORED,
    SKEWED,
    any_size,
    centred_camera,
    farthest_px,
    lens_camera,
    pasted,
    skewed_camera,
)

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import FORMATS, CameraSet, PosedCamera, read_cameras, written
from lucida.renderer.files.cameras.given import Given, Options
from lucida.renderer.system.errors import LucidaError

CAMERAS = {
    "view": skewed_camera,
    "opengl": skewed_camera,
    "opencv": skewed_camera,
    "gltf": centred_camera,
}
_BROWN = ("simple radial", "radial", "opencv", "plumb bob", "rational")
_FISHEYES = ("simple fisheye", "fisheye", "equidistant")
HELD = {
    "view": (*LENSES,),
    "opencv": (*_BROWN, "thin prism", *_FISHEYES),
}
WRITTEN = [entry.name for entry in FORMATS if entry.endings]
PERSPECTIVE_ONLY = ("opencv",)
SINGLE, UNSIZED = ("view", "opengl", "opencv"), ("view", "opengl", "gltf")
WAYS = [
    (name, projection)
    for name in WRITTEN
    for projection in ("perspective", "parallel")
    if projection == "perspective" or name not in PERSPECTIVE_ONLY
]


def again(cameras: list[PosedCamera], format: str, options: Options) -> CameraSet:
    """Write cameras and read them."""
    return pasted(written(cameras, format, options), options=options)


PLANES = [(None, None), (0.1, 50.0), (7.0, None), (None, 0.03)]


def assert_same_planes(camera: Camera, other: Camera) -> None:
    """As far away in the world. A format that must have both puts the one that is not given far
    from the other."""
    across = (np.cross(one.u, one.v) for one in (camera, other))
    n, m = (
        abs(x @ one.w) / np.linalg.norm(x) for x, one in zip(across, (camera, other), strict=True)
    )
    for given, found in ((camera.near, other.near), (camera.far, other.far)):
        if given is not None:
            assert found is not None and found * m == pytest.approx(given * n)
    if camera.near is None and camera.far is None:
        assert other.near is None and other.far is None
    elif (camera.near is None or camera.far is None) and other.near and other.far:
        assert other.far >= 999 * other.near


@pytest.mark.parametrize(("name", "projection"), WAYS)
def test_random_cameras_come_back(name: str, projection: str) -> None:
    random = np.random.default_rng(1)
    for number in range(16):
        camera, size = CAMERAS[name](random, projection), any_size(random)
        if name not in PERSPECTIVE_ONLY:
            near, far = PLANES[number % 4]
            camera = replace(camera, near=near, far=far)
        options = Options((None, "center", "corner")[number % 3])
        if name in UNSIZED:
            options = replace(options, size=size)
        cameras = [PosedCamera(camera, size, "it's.png")]
        if name not in SINGLE:
            cameras.append(PosedCamera(camera, size, "other"))
        for _ in range(2):  # the second time from what was read
            found = again(cameras, name, options)
            assert found.format == name
            for one, other in zip(cameras, found.cameras, strict=True):
                assert farthest_px(camera, other.camera, size, random) < 1e-6
                assert_same_planes(camera, other.camera)
                assert name in SINGLE or other.name == one.name
                assert name == "view" or other.size == size
                assert other.camera.lens is None
            cameras = list(found.cameras)


@pytest.mark.parametrize("kind", LENSES)
@pytest.mark.parametrize("name", WRITTEN)
def test_a_lens_comes_back_or_is_refused(name: str, kind: str) -> None:
    random = np.random.default_rng(3)
    for number in range(2):
        size = (500, 500) if number % 2 else any_size(random)
        camera = lens_camera(random, kind, square=number % 2 == 1)
        cameras = [PosedCamera(camera, size, "a.png")]
        if kind not in HELD.get(name, ()):
            with pytest.raises(LucidaError, match=r"lens.*(--lens none|leave it out)") as raised:
                written(cameras, name)
            assert "\n" not in str(raised.value)
            continue
        found = again(cameras, name, Options()).cameras[0]
        assert farthest_px(camera, found.camera, size, random) < 1e-6
        assert found.camera.lens is not None
        for coefficient, value in found.camera.lens.coefficients.items():
            assert camera.lens is not None
            assert camera.lens.coefficient(coefficient) == pytest.approx(value, rel=1e-14)


def test_a_lens_measures_in_u_v_and_w() -> None:
    camera = lens_camera(np.random.default_rng(2), "opencv")
    longer = replace(camera, v=tuple(1.01 * x for x in camera.v))
    leaning = replace(
        camera, w=tuple(w + 0.01 * u for u, w in zip(camera.u, camera.w, strict=True))
    )
    for wrong in (longer, leaning):
        with pytest.raises(LucidaError, match=r"\bw: .* behind a lens, as"):
            written([PosedCamera(wrong, (64, 48))], "opencv")


def test_a_camera_that_no_rotation_holds_is_refused() -> None:
    cases = {
        "w: (0, 0, 1) is not at right angles to the others, as gltf requires": SKEWED,
        "u: (-1, 0, 0) is left-handed with v and w; gltf cannot mirror; negate u": MIRRORED,
        "w: (0.2, 0, 1) is not at right angles to the others, as gltf requires": ASKANCE,
    }
    for problem, posed in cases.items():
        with pytest.raises(LucidaError) as raised:
            written([posed], "gltf")
        told = str(raised.value).removeprefix(f"{posed.name}.")
        assert told.startswith(problem) and raised.value.remedy


PLAIN = PosedCamera(Camera(), (64, 64))
REFUSED = [
    *((name, [replace(PLAIN, size=None)], "size: is unknown") for name in PERSPECTIVE_ONLY),
    *((name, [PLAIN] * 2, "holds 2 cameras") for name in ("opencv", "opengl")),
    ("opengl", [PosedCamera(Camera(), fit=True)], "^size: is unknown"),
    ("opencv", [replace(PLAIN, camera=Camera(projection="parallel"))], "^projection: 'parallel'"),
    ("gltf", [PosedCamera(Camera(viewport=(-0.5, 0.7, -0.5, 0.5)))],
     "^viewport: .* is off the middle by 0.0833 of its width"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "cameras", "told"), REFUSED)
def test_a_camera_that_the_format_does_not_hold_is_refused(
    name: str, cameras: list[PosedCamera], told: str
) -> None:
    with pytest.raises(LucidaError, match=told) as raised:
        written(cameras, name)
    assert raised.value.remedy and "\n" not in str(raised.value)


@pytest.mark.parametrize("digits", [5, 7])
def test_cameras_with_rounded_poses_keep_one_calibration(digits: int) -> None:
    random = np.random.default_rng(digits)
    size = (120, 80) if digits == 5 else (1200, 800)  # 4e-6 of 1200 pixels would show
    cameras = []
    for number in range(12):
        u, v, w = np.round(centred_camera(random).basis, digits).T.tolist()
        camera = Camera((number, 0.5, 2), u, v, w, 1.0, (-0.3, 0.3, -0.2, 0.2))
        cameras.append(PosedCamera(camera, size, f"{number}.png"))
    found = again(cameras, "gltf", Options(size=size)).cameras
    assert len({one.camera.viewport for one in found}) == 1
    for one, other in zip(cameras, found, strict=True):
        np.testing.assert_allclose(one.camera.basis, other.camera.basis, atol=10.0**-digits)


def test_files_that_hold_no_camera_are_not_recognised() -> None:
    for data in (b"dear all: hello", b"\xff\xfe", b'{"a": 1}', b"", b"[1, 2]", b"x = 3\ny = 4"):
        with pytest.raises(LucidaError, match="is not a recognised camera format"):
            read_cameras(Given("letter", data))


@pytest.mark.parametrize(
    ("name", "data", "told"),
    [
        ("a.json", b'{"camera_angle_x": 0.7, "frames": [', "line 1, column 36: expecting value"),
        ("a.yml", b"fx: 5\noperator: J\xe9r\n", "UTF-8"),
    ],
)
def test_a_broken_file_is_reported_where_it_is_broken(
    tmp_path: Path, name: str, data: bytes, told: str
) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(LucidaError, match=told):
        read_cameras(tmp_path / name)
