"""A reading written down: in one formula, and as Python that makes its camera. Pure."""

from __future__ import annotations

from collections.abc import Iterable

from app.cameras.text import python
from app.detective.printed import Pasted
from app.detective.ranking import name
from app.detective.readings import (
    AXES,
    OTHER,
    TURNS,
    Convention,
    MatrixReading,
    Up,
    as_rows,
    scale_of,
)
from renderer.camera import Floats
from renderer.intrinsics import PixelOrigin

WHO = {
    "OpenGL": "OpenGL, Blender, glTF, NeRF: x right, y up, z back",
    "OpenCV": "OpenCV, COLMAP: x right, y down, z forward",
    "PyTorch3D": "PyTorch3D: x left, y up, z forward",
    "Direct3D": "Direct3D, Unity: x right, y up, z forward",
}


def formula(convention: Convention, up: Up) -> str:
    """Return what the matrix M does to a point, and where the camera's axes are in it."""
    m = "M transposed" if convention.columns else "M"
    if convention.way == "P = K [R | t]":
        return f"pixel ~ P (x, y, z, 1), P = {m}"
    if convention.way == "clip from world":
        down = "; image y = -clip y" if convention.flipped else ""
        return f"clip = C (x, y, z, 1), C = {m}{down}"
    signs = AXES[convention.axes]
    axes = ", ".join(
        f"{letter} = {'-' if sign < 0 else ''}column {number}"
        for letter, sign, number in zip("uvw", signs, (1, 2, 3), strict=True)
    )
    of = m if convention.way == "camera-to-world" else f"the inverse of {m}"
    turned = f" in the world with {OTHER[up]} up" if convention.turned else ""
    return f"the eye is column 4, {axes} of {of}{turned}"


def code(reading: MatrixReading, given: Pasted, up: Up, origin: PixelOrigin) -> str:
    """Return Python that makes the reading's camera from the matrix."""
    convention = reading.convention
    head = [f"# {name(convention, up)}"]
    if convention.way == "clip from world":
        return "\n".join([*head, python(reading.view)])
    if convention.way == "P = K [R | t]":
        return "\n".join([*head, *_taken_apart(reading, origin)])
    lines = ["import numpy as np", "from renderer import Camera", "", *_given(given, convention)]
    return "\n".join([*head, *lines, *_pose(reading, given, up, origin)]) + "\n"


def _given(given: Pasted, convention: Convention) -> list[str]:
    """Return code for the matrix M, for column vectors, from the numbers as given."""
    lines = []
    if given.K is not None:
        lines += _array("K", given.K)
    if given.t is not None:
        turned = ".T" if convention.columns else ""
        lines += [*_array("R", given.numbers.reshape(3, 3)), f"t = ({_numbers(given.t)})"]
        return [*lines, f"M = np.column_stack([R{turned}, t])"]
    if convention.columns:
        return [*lines, *_array("M", given.numbers.reshape(4, -1)), "M = M.T  # by columns"]
    return [*lines, *_array("M", given.numbers.reshape(-1, 4))]


def _pose(reading: MatrixReading, given: Pasted, up: Up, origin: PixelOrigin) -> list[str]:
    convention = reading.convention
    is_inverse = convention.way == "world-to-camera"
    affine = as_rows(given, convention.columns)[:3]
    is_plain = not convention.turned and scale_of(affine) == 1.0
    last = f"    size={reading.size}, pixel_origin={origin!r},".replace("'", '"')
    if given.K is not None and is_plain and convention.axes in ("OpenGL", "OpenCV"):
        pose = "camera_from_world" if is_inverse else "world_from_camera"
        axes = convention.axes.lower()
        return ["camera = Camera.from_intrinsics(", f'    K, {pose}=M, axes="{axes}",', last, ")"]
    lines = []
    if is_inverse and given.numbers.size != 16:
        lines.append("M = np.vstack([M, (0, 0, 0, 1)])")
    lines.append(f"C = {'np.linalg.inv(M)' if is_inverse else 'M'}[:3]  # world_from_camera")
    if scale_of(affine) != 1.0:
        lines.append("C[:, :3] /= abs(np.linalg.det(C[:, :3])) ** (1 / 3)  # without its scale")
    if convention.turned:
        rows = ", ".join(f"({', '.join(f'{one:g}' for one in row)})" for row in TURNS[up] + 0.0)
        lines.append(f"C = np.array([{rows}]) @ C  # its world has {OTHER[up]} up")
    if given.K is not None:
        if convention.axes != "OpenGL":
            signs = ", ".join(map(str, AXES[convention.axes]))
            lines.append(f"C = C * ({signs}, 1)  # right, up, back")
        start = '    K, world_from_camera=C, axes="opengl",'
        return [*lines, "camera = Camera.from_intrinsics(", start, last, ")"]
    camera = reading.view.camera
    fields = ", ".join(
        f"{letter}={'-' if sign < 0 else ''}C[:, {number}]"
        for number, (letter, sign) in enumerate(zip("uvw", AXES[convention.axes], strict=True))
    )
    lines += ["camera = Camera(", f"    eye=C[:, 3], {fields},"]
    lines.append(f"    distance={camera.distance!r}, viewport=({_numbers(camera.viewport)}),")
    clip = [
        f"{side}={value!r}"
        for side, value in (("near", camera.near), ("far", camera.far))
        if value is not None
    ]
    return [*lines, "    " + ", ".join([f'projection="{camera.projection}"', *clip]), ")"]


def _taken_apart(reading: MatrixReading, origin: PixelOrigin) -> list[str]:
    """Return code that decomposes P into K, R and t."""
    assert reading.size is not None
    k, rotation, t = reading.view.camera.intrinsics(reading.size, origin)
    size = f"    size={reading.size}, pixel_origin={origin!r},".replace("'", '"')
    return [
        "import numpy as np", "from renderer import Camera", "",
        "# P is the product K [R | t]",
        *_array("K", k), *_array("R", rotation), f"t = ({_numbers(t)})",
        "camera = Camera.from_intrinsics(",
        "    K, camera_from_world=np.column_stack([R, t]),", size, ")", "",
    ]  # fmt: skip


def _array(letter: str, matrix: Floats) -> list[str]:
    rows = [f"    [{_numbers(row)}]," for row in matrix]
    return [f"{letter} = np.array([", *rows, "])"]


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(repr(float(value) + 0.0) for value in values)
