"""A camera as in pbrt-v4's scene files: film, transform, camera.

pbrt's camera looks along +z with x to the right and y up, in a space of any basis; the screen
window is the viewport. It can therefore hold every camera of Lucida except for clip planes and
lenses; its spherical one is the equirectangular lens.
Write only. Source: pbrt-v4's documentation, "pbrt-v4 Input File Format".
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from renderer.camera import Camera, Size
from renderer.camera_checks import listed
from renderer.camera_formats.entries import in_image
from renderer.camera_formats.given import Options
from renderer.camera_formats.posed import PosedCamera
from renderer.camera_formats.rigid import UNSEEN_PX
from renderer.errors import LucidaError

LENSES = ("equirectangular",)


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    if len(cameras) != 1:
        problem = f"a scene of pbrt holds one camera, not {len(cameras)}"
        raise LucidaError("", problem, "choose one with --frame or --image")
    camera, size = in_image(cameras[0], options, "pbrt")
    lines = camera_lines(camera, size)
    return {"": ("\n".join(lines) + "\n").encode()}


def camera_lines(camera: Camera, size: Size, picture: str = "lucida.exr") -> list[str]:
    """Return the film and the camera, for the part before WorldBegin.

    picture: the file that pbrt should write. Raises LucidaError.
    """
    for name in ("near", "far"):
        if (value := getattr(camera, name)) is not None:
            problem = f"{value:g} clips, and pbrt's cameras clip nothing"
            raise LucidaError(name, problem, f"leave {name} out")
    camera_from_world = np.eye(4)
    basis = camera.basis * (1.0, 1.0, -1.0)
    if camera.lens is not None:
        _check_whole_sphere(camera, size)
        # The picture begins at its x axis, behind, and turns by its z axis, on the left.
        basis = np.column_stack([camera.w, camera.v, -np.asarray(camera.u)])
    camera_from_world[:3, :3] = np.linalg.inv(basis)
    camera_from_world[:3, 3] = -camera_from_world[:3, :3] @ np.asarray(camera.eye)
    edges = np.array(camera.viewport)
    if camera.is_parallel:
        kind = '"orthographic"'
    else:
        kind = '"perspective" "float fov" [ 90 ]'  # the screen window is at distance 1
        edges = edges / camera.distance
    kind += f' "float screenwindow" [ {numbers(edges)} ]'
    if camera.lens is not None:
        kind = '"spherical" "string mapping" "equirectangular"'
    return [
        f'Film "rgb" "integer xresolution" [ {size[0]} ] "integer yresolution" [ {size[1]} ] '
        f'"string filename" [ "{picture}" ]',
        f"Transform [ {listed_by_columns(camera_from_world)} ]",
        f"Camera {kind}",
    ]


def _check_whole_sphere(camera: Camera, size: Size) -> None:
    """Raise LucidaError unless an equirectangular camera sees the whole sphere, as pbrt's does."""
    whole = np.pi * np.array([-1, 1, -0.5, 0.5])
    pixels = np.abs(np.array(camera.viewport) / camera.distance - whole) / (whole[1::2].repeat(2))
    if (pixels / 2 * np.repeat(size, 2) > UNSEEN_PX).any():
        problem = f"{listed(camera.viewport)} is not the whole sphere that pbrt's camera sees"
        raise LucidaError("viewport", problem, f"give {listed(whole * camera.distance)}")


def listed_by_columns(matrix: np.ndarray) -> str:
    """Return a matrix's numbers in pbrt's order."""
    return numbers(matrix.T.ravel())


def numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
