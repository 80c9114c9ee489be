"""A notebook's display of frames, cameras and scenes: PNG, SVG and HTML, without scripts.

The classes' own `_repr_png_` and `_repr_html_` call these functions, so that they are imported only
in notebooks.
"""

from __future__ import annotations

import base64
import html
import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images import picture
from lucida.renderer.images.display import depth_gray
from lucida.renderer.images.frame import CHANNELS, Frame
from lucida.renderer.images.png import png_of

if TYPE_CHECKING:
    from lucida.renderer.scene import Scene

_SCENE_SIZE = (320, 240)
_BAR = 16  # width of a colour bar, in pixels
_MOST_ROWS = 12  # of a scene's contents
_DRAWING = (300, 220)  # of a camera
_STEPS = 24  # of each side of a lens's border
_COLORS = {"u": "#c2410c", "v": "#15803d", "w": "#1d4ed8"}


@dataclass(frozen=True)
class Shown:
    """A channel of a frame for display in a notebook."""

    frame: Frame
    channel: str

    def __repr__(self) -> str:
        return f"{self.channel} of {self.frame!r}"

    def _repr_html_(self) -> str:
        data = self.frame.channel(self.channel)
        image = _image(png(self.frame, self.channel))
        return f"<div style='display:flex;gap:8px'>{image}{self._bar()}</div>{_shape(data)}"

    def _bar(self) -> str:
        """Return a colour bar with its values; "" for channels whose values are colours."""
        if self.channel != "depth":
            return ""
        depth = self.frame.channel("depth")
        hit = depth[np.isfinite(depth)]
        if not hit.size:
            return "nothing is hit"
        near, far = float(hit.min()), float(hit.max())
        steps = np.linspace(near, far, 128, dtype=np.float32)
        bar = np.repeat(depth_gray(steps[:, None])[..., None], 3, axis=2).repeat(_BAR, axis=1)
        labels = f"<span>t = {near:.4g}</span><span>{far:.4g}</span>"
        column = "display:flex;flex-direction:column;justify-content:space-between"
        return f"{_image(png_of(bar), 'height:100%')}<div style='{column}'>{labels}</div>"


def frame_png(frame: Frame) -> bytes | None:
    """Return the first rendered channel as a PNG file; None if there is none."""
    rendered = [name for name in CHANNELS if getattr(frame, name) is not None]
    return png(frame, rendered[0]) if rendered else None


def png(frame: Frame, channel: str) -> bytes:
    return png_of(picture(frame, channel))


def camera_html(camera: Camera) -> str:
    """Return a drawing of a camera, and its numbers in a table."""
    rows = [(name, _vector(getattr(camera, name))) for name in ("eye", "u", "v", "w")]
    rows += [
        ("distance", f"{camera.distance:.6g}"),
        (
            "viewport",
            "left {:.4g}, right {:.4g}, bottom {:.4g}, top {:.4g}".format(*camera.viewport),
        ),
        ("projection", camera.projection),
    ]
    if not camera.is_parallel:
        angles = f"{camera.fov_x_deg:.4g} across, {camera.fov_y_deg:.4g} up and down, in degrees"
        rows.append(("field of view", angles))
    if camera.lens is not None:
        rows.append(("lens", str(camera.lens)))
    rows += [(name, f"{value:.6g}") for name in ("near", "far") if (value := getattr(camera, name))]
    return f"<div style='display:flex;gap:16px'>{camera_svg(camera)}{_table(rows)}</div>"


def camera_svg(camera: Camera) -> str:
    """Return a drawing of a camera from outside: the eye, its basis, the viewport and its rays.

    With a lens, the viewport joins the ends of its border's directions.
    """
    eye, basis = np.asarray(camera.eye), camera.basis
    left, right, bottom, top = camera.viewport
    corners = np.array([(left, top), (right, top), (right, bottom), (left, bottom)])
    across = corners @ basis[:, :2].T
    ends = border = eye + across - camera.distance * basis[:, 2]
    starts = eye + across if camera.is_parallel else np.tile(eye, (4, 1))
    if camera.lens is not None:
        i, j = np.array([(0, 0, 1, 1, 0), (0, 1, 1, 0, 0)]) - 0.5
        around = np.arange(4 * _STEPS) / _STEPS
        i, j = (np.interp(around, np.arange(5), side) for side in (i, j))
        border = eye + camera.ray(i, j, (1, 1)).direction
        seen = np.isfinite(border[:, 0])
        ends, border = border[::_STEPS][seen[::_STEPS]], border[seen]
    tips = eye + 0.6 * np.abs(corners).max() * (basis / np.linalg.norm(basis, axis=0)).T
    parts = (eye[None], border, ends, starts[: len(ends)], tips)
    (x, y), size = _projected(np.vstack(parts), basis), _DRAWING
    named = [f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True)]
    cuts = np.cumsum([0, *map(len, parts)]).tolist()
    (middle,), outline, ends_at, starts_at, tips_at = (
        named[low:high] for low, high in itertools.pairwise(cuts)
    )
    rays = [
        f"<path d='M{start} L{end}' stroke='#888' fill='none'/>"
        for start, end in zip(starts_at, ends_at, strict=True)
    ]
    image = f"<polygon points='{' '.join(outline)}' fill='#9994' stroke='#666'/>"
    arrows = [
        f"<path d='M{middle} L{tip}' stroke='{color}' stroke-width='2.5'/>"
        f"<text x='{a + 3:.0f}' y='{b - 3:.0f}' fill='{color}' font-weight='bold'>{name}</text>"
        for (name, color), tip, a, b in zip(_COLORS.items(), tips_at, x[-3:], y[-3:], strict=True)
    ]
    dot = f"<circle cx='{x[0]:.1f}' cy='{y[0]:.1f}' r='3.5' fill='currentColor'/>"
    box = f"width='{size[0]}' height='{size[1]}' viewBox='0 0 {size[0]} {size[1]}'"
    title = f"<title>Camera at {_vector(camera.eye)}</title>"
    head = f"<svg xmlns='http://www.w3.org/2000/svg' role='img' {box} font-size='14'>"
    return f"{head}{title}{''.join(rays)}{image}{''.join(arrows)}{dot}</svg>"


def _projected(points: np.ndarray, basis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return points in the drawing's pixels, seen from behind, above and the right of a camera."""
    u, v, w = (basis / np.linalg.norm(basis, axis=0)).T
    outside = Camera.look_at(eye=0.9 * u + 0.6 * v + 1.2 * w, target=(0, 0, 0), up=v)
    flat = (points - points.mean(axis=0)) @ np.array([outside.u, outside.v]).T
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = np.array(_DRAWING) - 40
    scale = (room / np.maximum(high - low, 1e-12)).min()
    x, y = ((flat - (low + high) / 2) * scale * (1, -1) + np.array(_DRAWING) / 2).T
    return x, y


def scene_html(scene: Scene) -> str:
    """Return a picture of a scene from its own view, by the ray tracer, and its contents."""
    from lucida.renderer.editing import outline
    from lucida.renderer.trace import Tracer

    with Tracer(scene) as tracer:
        frame = tracer.render(scene.view.for_size(_SCENE_SIZE), _SCENE_SIZE, channels=("color",))
    rows = outline(scene)
    named = [
        (row.shown, row.kind + (f", {row.triangles:,} triangles" if row.triangles else ""))
        for row in rows[:_MOST_ROWS]
    ]
    if len(rows) > _MOST_ROWS:
        named.append((f"and {len(rows) - _MOST_ROWS} more", ""))
    image = _image(png(frame, "color"))
    return (
        f"<div style='display:flex;gap:16px'>{image}{_table(named)}</div>{html.escape(repr(scene))}"
    )


def _image(data: bytes, style: str = "") -> str:
    encoded = base64.b64encode(data).decode()
    return f"<img src='data:image/png;base64,{encoded}' style='image-rendering:pixelated;{style}'>"


def _shape(data: np.ndarray) -> str:
    sides = " x ".join(map(str, data.shape))
    return f"<div>{sides}, {data.dtype}: [row, column], row 0 at the top</div>"


def _table(rows: Iterable[tuple[str, str]]) -> str:
    cells = (f"<tr><th>{html.escape(a)}</th><td>{html.escape(b)}</td></tr>" for a, b in rows)
    return f"<table>{''.join(cells)}</table>"


def _vector(vector: Sequence[float]) -> str:
    return f"({', '.join(f'{part:.6g}' for part in vector)})"
