"""Mitsuba's shading of an exported file, by its documentation: read from the file alone.

Source: Mitsuba 3's documentation, "Plugin reference"; Dupuy and Jakob 2018 for measured materials.
"""

from __future__ import annotations

import math
import re
import struct
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from renderer.images.display import from_srgb

Floats = NDArray[np.float64]
PARSED = {1: "u1", 10: "<f4"}


class MitsubaFile:
    """The shapes, lights and colours of an exported .xml file."""

    def __init__(self, path: Path) -> None:
        self.folder, self.root = path.parent, ElementTree.parse(path).getroot()
        self.shapes = {
            int((shape.get("id") or "").removeprefix("object-")): shape
            for shape in self.root.findall("shape")
        }

    @property
    def background(self) -> Floats:
        constant = self.root.find("emitter[@type='constant']")
        return np.zeros(3) if constant is None else _numbers(_named(constant, "radiance"))

    def radiance(self, number: int, p: Floats, n: Floats, to_eye: Floats) -> Floats:
        """The light (k, 3) from points of a sphere or a flat mesh to the eye, with unit normals on
        its side; unoccluded."""
        shape = self.shapes[number]
        place = _matrix(_named(shape, "to_world"))
        local = np.column_stack([p, np.ones(len(p))]) @ np.linalg.inv(place).T
        if shape.get("type") == "sphere":
            x, y, z, _ = local.T
            at = {
                "u": np.arctan2(y, x) / (2 * math.pi) % 1,
                "v": np.arccos(z.clip(-1, 1)) / math.pi,
            }
            front = p - place[:3, 3]
            front = -front if shape.find("boolean[@name='flip_normals']") is not None else front
        else:
            mesh = ply_arrays(self.folder / _value(shape, "filename"))
            corners = np.column_stack([mesh[axis] for axis in "xyz"] + [np.ones(len(mesh["x"]))])
            at = {
                k: local @ np.linalg.lstsq(corners, v)[0] for k, v in mesh.items() if k != "faces"
            }
            a, b, c = (corners @ place.T)[mesh["faces"][0], :3]
            front = np.cross(b - a, c - a)
        emitted, bsdf = shape.find("emitter"), shape.find("bsdf/bsdf")
        assert bsdf is not None and shape.find("bsdf").get("type") == "twosided"
        found = np.zeros_like(p)
        if emitted is not None:
            assert emitted.get("type") == "area" and _value(emitted, "sampling_weight") == 0
            is_front = (front * to_eye).sum(axis=1, keepdims=True) > 0
            found += is_front * self._color(_named(emitted, "radiance"), at)
        for light in self.root.findall("emitter"):
            if light.get("type") == "point":
                away = _numbers(_named(light, "position")) - p
                far = np.linalg.norm(away, axis=1, keepdims=True)
                arriving, to_light = _numbers(_named(light, "intensity")) / far**2, away / far
            elif light.get("type") == "directional":
                to_light = np.broadcast_to(-_numbers(_named(light, "direction")), p.shape)
                to_light = to_light / np.linalg.norm(to_light, axis=1, keepdims=True)
                arriving = np.broadcast_to(_numbers(_named(light, "irradiance")), p.shape)
            else:
                assert _value(light, "sampling_weight") == 0
                continue
            faced = (to_light * n).sum(axis=1, keepdims=True)
            found += np.where(faced > 0, arriving * self._bsdf(bsdf, n, to_light, to_eye, at), 0)
        return found

    def _bsdf(self, bsdf, n: Floats, to_light: Floats, to_eye: Floats, at) -> Floats:
        """Times the light's cosine."""
        if bsdf.get("type") == "diffuse":
            color = self._color(_named(bsdf, "reflectance"), at)
            return color / math.pi * (n * to_light).sum(axis=1, keepdims=True)
        if bsdf.get("type") == "blendbsdf":
            first, second = bsdf.findall("bsdf")
            weight, given = _value(bsdf, "weight"), (n, to_light, to_eye, at)
            return (1 - weight) * self._bsdf(first, *given) + weight * self._bsdf(second, *given)
        assert bsdf.get("type") == "measured"
        table = tensor_fields((self.folder / _value(bsdf, "filename")).read_bytes())
        half = to_light + to_eye
        half /= np.linalg.norm(half, axis=1, keepdims=True)
        u = np.sqrt(np.arccos(np.clip((half * n).sum(axis=1), 0, 1)) * 2 / math.pi)
        ndf, rgb = table["ndf"], table["rgb"]
        # What does not depend on the other coordinates is one number for all of them.
        for part in (ndf.T, table["sigma"], *rgb[0].transpose(1, 0, 2, 3), table["vndf"]):
            assert (part.reshape(len(part), -1) == part.reshape(len(part), -1)[:, :1]).all()
        assert rgb.shape[:3] == (len(table["phi_i"]), len(table["theta_i"]), 3)
        assert table["jacobian"] == 1 and table["luminance"].shape[2:] == rgb.shape[3:]
        spread = np.interp(u, np.linspace(0, 1, ndf.shape[1]), ndf[0])
        return spread[:, None] * rgb[0, 0, :, 0, 0] / (4 * table["sigma"][0, 0])

    def _color(self, entry, at: dict[str, Floats]) -> Floats:
        """at: coordinates u and v, and the vertices' attributes, at each point."""
        points = len(next(iter(at.values())))
        if entry.tag == "rgb":
            return np.broadcast_to(_numbers(entry), (points, 3))
        if entry.get("type") == "mesh_attribute":
            columns = {"vertex_color": "rgb", "vertex_ambient": [f"ambient_{k}" for k in range(3)]}
            return np.column_stack([at[name] for name in columns[_value(entry, "name")]])
        uv = np.column_stack([at["u"], at["v"]])
        if entry.get("type") == "checkerboard":
            cells = np.mod(uv, 1) > 0.5
            colors = [_numbers(_named(entry, f"color{k}")) for k in range(2)]
            return np.where(cells[:, :1] != cells[:, 1:], colors[1], colors[0])
        assert entry.get("type") == "bitmap"
        place = _matrix(_named(entry, "to_uv"))
        u, v = uv.T * np.diag(place)[:2, None] + place[:2, 3:]
        return bilinear(self.folder / _value(entry, "filename"), u, v, _value(entry, "wrap_mode"))


def bilinear(image: Path, u: Floats, v: Floats, wrap: str) -> Floats:
    """The light of an image at coordinates from its upper left corner."""
    light = from_srgb(np.asarray(Image.open(image))).astype(float)
    height, width, _ = light.shape
    x, y = u * width - 0.5, v * height - 0.5
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    right, down = (x - column)[:, None], (y - row)[:, None]
    columns = [_wrapped(column + k, width, wrap) for k in range(2)]
    rows = [_wrapped(row + k, height, wrap) for k in range(2)]
    upper, lower = (
        light[at, columns[0]] * (1 - right) + light[at, columns[1]] * right for at in rows
    )
    return upper * (1 - down) + lower * down


def ply_arrays(path: Path) -> dict[str, NDArray]:
    """The columns of a binary PLY file's vertices, by name, and its triangles as "faces"."""
    head, _, rest = path.read_bytes().partition(b"end_header\n")
    names = re.findall(r"property float (\S+)", head.decode())
    counts = [int(count) for count in re.findall(r"element \S+ (\d+)", head.decode())]
    rows = np.frombuffer(rest, "<f4", counts[0] * len(names)).reshape(counts[0], -1)
    kind = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    faces = np.frombuffer(rest, kind, counts[1], rows.nbytes)
    assert (faces["count"] == 3).all() and len(rest) == rows.nbytes + faces.nbytes
    return dict(zip(names, rows.T.astype(float), strict=True)) | {"faces": faces["corners"]}


def tensor_fields(data: bytes) -> dict[str, Floats]:
    """The arrays of a tensor file, by name."""
    assert data[:14] == b"tensor_file\0\1\0"
    fields, at = {}, 18
    for _ in range(struct.unpack("<I", data[14:18])[0]):
        (length,) = struct.unpack("<H", data[at : at + 2])
        name = data[at + 2 : at + 2 + length].decode()
        at += 2 + length
        count, kind, start = struct.unpack("<HBQ", data[at : at + 11])
        shape = struct.unpack(f"<{count}Q", data[at + 11 : at + 11 + 8 * count])
        at += 11 + 8 * count
        fields[name] = np.ndarray(shape, PARSED[kind], data, start).astype(float)
    return fields


def _wrapped(index: NDArray[np.int64], size: int, wrap: str) -> NDArray[np.int64]:
    if wrap == "clamp":
        return np.clip(index, 0, size - 1)
    if wrap == "repeat":
        return index % size
    return np.minimum(index % (2 * size), 2 * size - 1 - index % (2 * size))


def _matrix(transform) -> Floats:
    return np.array(transform.find("matrix").get("value").split(), float).reshape(4, 4)


def _named(element, name: str):
    (found,) = (child for child in element if child.get("name") == name)
    return found


def _value(element, name: str):
    entry = _named(element, name)
    return float(entry.get("value")) if entry.tag == "float" else entry.get("value")


def _numbers(entry) -> Floats:
    if entry.tag == "rgb":
        return np.array(entry.get("value").split(","), float)
    return np.array([entry.get(axis) for axis in "xyz"], float)
