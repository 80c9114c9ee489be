"""`lucida pick`: what one pixel of an image sees, in numbers: those of the image from `render`."""

from __future__ import annotations

import argparse
import json
import math
from typing import TYPE_CHECKING, Any

from app.cameras.options import add_camera_options
from app.commands import arguments as common
from app.commands.given_camera import add_view_option
from renderer.errors import LucidaError, one_line
from renderer.pixels import Indexing, Pixel

if TYPE_CHECKING:
    from renderer.camera import Camera
    from renderer.frame import Frame
    from renderer.scene.model import Scene

NAME = "pick"

DESCRIPTION = """\
Say what one pixel of an image sees: the object, the ray parameter t, point, normal and colour.
Rows are counted from the top, columns from the left; from 0, or with --from 1 from 1."""

EPILOG = """\
t counts as in `lucida render --channel depth`: 1 on the image plane in perspective. The normal is
of unit length and faces the viewer; the colour is linear light, and sRGB as in a picture.
exit status: 0 told (also that the pixel sees the background), 2 a mistake or a failure,
130 interrupted

examples:
  lucida pick spheres 360 640
  lucida pick spheres 361 641 --from 1
  lucida pick bunny.obj 100 200 --size 640x480 --view corner.toml --json"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", metavar="SCENE", help=common.SCENE_HELP)
    parser.add_argument("row", type=_whole, metavar="ROW", help="the pixel's row")
    parser.add_argument("column", type=_whole, metavar="COLUMN", help="and its column")
    common.add_from_option(parser)
    common.add_size_option(parser)
    parser.add_argument(
        "--renderer", choices=("raster", "ray"), default="ray", help="(default: ray)"
    )
    parser.add_argument(
        "--backend", choices=common.BACKENDS, default="auto", help=common.BACKEND_HELP
    )
    add_view_option(parser)
    add_camera_options(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: argparse.Namespace) -> int:
    posed = common.own_camera(arguments)
    pixel = _pixel(arguments)
    scene, camera = common.scene_and_camera(arguments, posed)
    frame = _drawn(scene, camera, arguments)
    seen = picked(scene, camera, frame, pixel, arguments.indexing)
    seen["renderer"] = arguments.renderer
    print(json.dumps(seen, indent=2, allow_nan=False) if arguments.json else as_text(seen))
    return 0


def picked(
    scene: Scene, camera: Camera, frame: Frame, pixel: Pixel, indexing: Indexing
) -> dict[str, Any]:
    """Return a pixel of a frame with all channels, as JSON values.

    object, t, point and normal are None for the background; outside of the lens, the ray is, too.
    indexing: of the printed pixel.
    """
    from renderer.images import to_srgb8

    ray = camera.ray(*pixel, frame.size)
    color = frame.channel("color")[pixel]
    number = int(frame.channel("id")[pixel])
    hit = number >= 0
    t = float(frame.channel("depth")[pixel])
    is_seen = math.isfinite(ray.direction[0])
    return {
        "pixel": list(indexing.numbers(pixel)),
        "pixels_from": indexing.value,
        "size": list(frame.size),
        "object": {"id": number, "name": scene.objects[number].name} if hit else None,
        "t": t if hit else None,
        "point": (ray.origin + t * ray.direction).tolist() if hit else None,
        "normal": frame.channel("normal")[pixel].tolist() if hit else None,
        "color": color.tolist(),
        "srgb": to_srgb8(color).tolist(),
        "ray": {"origin": ray.origin.tolist(), "direction": ray.direction.tolist()}
        if is_seen
        else None,
    }


def as_text(seen: dict[str, Any]) -> str:
    """Return the same as text, a line for each quantity."""
    indexing, (width, height) = Indexing(seen["pixels_from"]), seen["size"]
    where = indexing.words(indexing.pixel(*seen["pixel"]))
    lines = [("pixel", f"{where} of {width}x{height}, {indexing.told} ({seen['renderer']})")]
    if seen["object"] is None:
        where = "the background" if seen["ray"] else "outside of the lens"
        lines.append(("object", f"none: {where}"))
    else:
        entry = seen["object"]
        lines.append(("object", one_line(f"{entry['id']} {entry['name']}")))
        lines.append(("t", f"{seen['t']:.6g}"))
        lines += [(name, _vector(seen[name])) for name in ("point", "normal")]
    red, green, blue = seen["srgb"]
    srgb = f"sRGB {red} {green} {blue}, #{red:02x}{green:02x}{blue:02x}"
    lines.append(("color", f"{_vector(seen['color'])} linear light; {srgb}"))
    lines += [(f"ray {name}", _vector(part)) for name, part in (seen["ray"] or {}).items()]
    return "\n".join(f"{name:14}{text}" for name, text in lines)


def _pixel(arguments: argparse.Namespace) -> Pixel:
    """Return the requested pixel. Raises LucidaError if it is outside the image."""
    first = arguments.indexing.value
    counts = {
        "ROW": (arguments.row, arguments.size[1]),
        "COLUMN": (arguments.column, arguments.size[0]),
    }
    for name, (value, count) in counts.items():
        if not first <= value < count + first:
            problem = f"{value} is outside an image of {arguments.size[0]}x{arguments.size[1]}"
            raise LucidaError(name, problem, f"give {first} to {count + first - 1}")
    pixel: Pixel = arguments.indexing.pixel(arguments.row, arguments.column)
    return pixel


def _drawn(scene: Scene, camera: Camera, arguments: argparse.Namespace) -> Frame:
    """Render the whole image, so that the pixel is the same as in a file."""
    with common.progress_bar(arguments.renderer) as progress:
        if arguments.renderer == "raster":
            from renderer.raster import Rasterizer

            with Rasterizer(scene, backend=arguments.backend) as rasterizer:
                return rasterizer.render(camera, arguments.size, progress=progress)
        from renderer.trace import Tracer

        with Tracer(scene) as tracer:
            return tracer.render(camera, arguments.size, progress=progress)


def _vector(values: list[float]) -> str:
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number; give e.g. 12") from None
