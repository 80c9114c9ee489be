"""Report one pixel of an image in numbers: its ray and the hit."""

from __future__ import annotations

import math
from typing import Any

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import Pixel
from lucida.renderer.images import to_srgb8
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import one_line


def picked(scene: Scene, camera: Camera, frame: Frame, pixel: Pixel) -> dict[str, Any]:
    """Return a pixel of a frame with all channels, as JSON values.

    object, t, z (the distance along -w), point and normal are None for the background. The ray is
    None, too, outside the lens.
    """
    ray = camera.ray(*pixel, frame.size)
    color = frame.channel("color")[pixel]
    number = int(frame.channel("id")[pixel])
    hit = number >= 0
    t = float(frame.channel("depth")[pixel])
    is_seen = math.isfinite(ray.direction[0])
    point = ray.origin + t * ray.direction
    return {
        "pixel": list(pixel),
        "size": list(frame.size),
        "object": {"id": number, "name": scene.objects[number].name} if hit else None,
        "t": t if hit else None,
        "z": -float(camera.camera_from_world[2] @ [*point, 1.0]) if hit else None,
        "point": point.tolist() if hit else None,
        "normal": frame.channel("normal")[pixel].tolist() if hit else None,
        "color": color.tolist(),
        "srgb": to_srgb8(color).tolist(),
        "ray": {"origin": ray.origin.tolist(), "direction": ray.direction.tolist()}
        if is_seen
        else None,
    }


def as_text(seen: dict[str, Any]) -> str:
    """Return picked()'s values as text, a line for each quantity."""
    return "\n".join(f"{name:14}{text}" for name, text in as_rows(seen))


def as_rows(seen: dict[str, Any]) -> list[tuple[str, str]]:
    """Return picked()'s values as names and texts."""
    (row, column), (width, height) = seen["pixel"], seen["size"]
    lines = [("pixel", f"row {row}, column {column} of {width}x{height}, from 0")]
    if seen["object"] is None:
        where = "the background" if seen["ray"] else "outside of the lens"
        lines.append(("object", f"none: {where}"))
    else:
        entry = seen["object"]
        lines.append(("object", one_line(f"{entry['id']} {entry['name']}")))
        lines += [(name, f"{seen[name]:.6g}") for name in "tz"]
        lines += [(name, _vector(seen[name])) for name in ("point", "normal")]
    red, green, blue = seen["srgb"]
    srgb = f"sRGB {red} {green} {blue}, #{red:02x}{green:02x}{blue:02x}"
    lines.append(("color", f"{_vector(seen['color'])} linear light; {srgb}"))
    lines += [(f"ray {name}", _vector(part)) for name, part in (seen["ray"] or {}).items()]
    return lines


def _vector(values: list[float]) -> str:
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"
