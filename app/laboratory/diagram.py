"""The diagram of the page "Raster and vector": the objects' outlines, and the figure as pixels."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from app.objects.silhouette import MOST_TRIANGLES, edges_of, outline_of
from app.outside.diagram import Segments, runs
from app.outside.figure import WHITE, Color, Figure, Label, Polygon, dashes
from renderer.camera import Camera
from renderer.scene.model import Mesh, Scene

SAMPLES = 4  # a side of a pixel
SHARP_DEG = 35.0  # between the planes of two triangles
OUTLINE, OPACITY = 1.5, 0.6


def outlines(scene: Scene, camera: Camera) -> list[Segments]:
    """Return the outlines and sharp edges of a scene's objects, without their hidden parts."""
    found = []
    for number, entry in scene.visible:
        lines = outline_of(entry, camera)
        if isinstance(entry.shape, Mesh) and len(entry.shape.faces) <= MOST_TRIANGLES:
            lines = np.concatenate([lines, _sharp_edges(entry.shape)])
        name = entry.name or f"object {number}"
        found.append(Segments(name, "text", lines, OUTLINE, OPACITY, hidden=0.0, layer=0))
    return found


def _sharp_edges(mesh: Mesh) -> NDArray[np.float64]:
    """Return the edges (n, 2, 3) between triangles whose planes form an angle, in world space."""
    linear, shift = mesh.transform[:3, :3], mesh.transform[:3, 3]
    edges = edges_of(mesh)
    with np.errstate(all="ignore"):
        normals = edges.planes[:, :3] @ np.linalg.inv(linear)
        normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    cosines = np.einsum("ij,ij->i", *(normals[edges.sides[:, k]] for k in range(2)))
    is_sharp = np.where(edges.turned, -cosines, cosines) < math.cos(math.radians(SHARP_DEG))
    world: NDArray[np.float64] = edges.ends[is_sharp] @ linear.T + shift
    return world


def bitmap(figure: Figure, size: tuple[int, int]) -> NDArray[np.uint8]:
    """Return a figure's lines and labels at (width, height) pixels: (height, width, 3), as
    displayed. The figure should have the same aspect ratio.

    Each pixel is the mean of SAMPLES x SAMPLES points (a box filter).
    """
    scale = SAMPLES * size[0] / figure.size[0]
    ground = _ink(figure.ground or WHITE)
    picture = Image.new("RGB", (SAMPLES * size[0], SAMPLES * size[1]), ground[:3])
    draw = ImageDraw.Draw(picture, "RGBA")
    for part in figure.parts:
        if isinstance(part, Label):
            em = part.size * scale
            bold = 0.04 * em if part.strong else 0.0
            x, y = part.center
            text = "".join(piece for piece, _ in runs(part.text, part.strong))
            for width, color in ((0.09 * em + bold, ground), (bold, _ink(part.color))):
                draw.text((scale * x, scale * y), text, fill=color, anchor="mm",
                          font=ImageFont.load_default(size=em),
                          stroke_width=round(width), stroke_fill=color)  # fmt: skip
            continue
        ink = _ink(part.color, part.opacity)
        if isinstance(part, Polygon):
            draw.polygon(_spots(part.points, scale), fill=ink)
            continue
        width = max(1, round(part.width * scale))
        for piece in part.pieces:
            for points in dashes(piece, figure.unit) if part.dashed else [piece]:
                draw.line(_spots(points, scale), fill=ink, width=width, joint="curve")
    return np.asarray(picture.resize(size, Image.Resampling.BOX), np.uint8).copy()


def _spots(points: NDArray[np.float64], scale: float) -> list[tuple[float, float]]:
    """Return points as Pillow takes them, which counts from the middle of the first pixel."""
    return [(x, y) for x, y in (points * scale - 0.5).tolist()]


def magnified(
    picture: NDArray[np.uint8],
    size: tuple[int, int],
    corner: tuple[float, float],
    extent: tuple[float, float],
) -> NDArray[np.uint8]:
    """Return a part of a picture at (width, height) pixels of a screen, by nearest neighbour.

    corner, extent: of the part, in parts of the picture's width and height.
    """
    rows, columns = (
        np.clip(
            ((corner[axis] + (np.arange(size[axis]) + 0.5) / size[axis] * extent[axis])
             * picture.shape[1 - axis]).astype(int),
            0,
            picture.shape[1 - axis] - 1,
        )
        for axis in (1, 0)
    )  # fmt: skip
    return picture[rows[:, None], columns]


def _ink(color: Color, opacity: float = 1.0) -> tuple[int, int, int, int]:
    red, green, blue, alpha = (round(255 * min(max(v, 0.0), 1.0)) for v in (*color, opacity))
    return red, green, blue, alpha
