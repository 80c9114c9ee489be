"""`lucida camera`: describe a camera of any format in the lecture's words, or convert it.

It is quick to import.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import LucidaError, counted, errors_as, one_line, visible

from . import arguments as common
from .given_camera import say_changes, say_notes

if TYPE_CHECKING:
    from lucida.renderer.files.cameras import CameraSet, PosedCamera
    from lucida.renderer.files.cameras.formats import Format

NAME = "camera"

DESCRIPTION = """\
Describe a camera of any format: eye, basis, viewport, d, fields of view, focal lengths, principal
point, and the conventions of its file. With --to or -o, write it in another format."""

EPILOG = """\
formats: view (Lucida's view file), opencv (also ROS, ORB-SLAM, VINS and Kalibr), gltf
(for Blender, three.js and engines), opengl; colmap and nerf are only read. docs/cameras.md says
what each holds, and has the formulas.

If a file has several cameras, INPUT#12 or INPUT#IMG_7.jpg selects one.
Otherwise all are written, if the format holds several, and none if it cannot hold one of them.
exit status: 0 done, 2 a mistake or a failure (one line says which), 130 interrupted

examples:
  lucida camera transforms.json                     what it holds
  lucida camera transforms.json#12                  one of its cameras, with all numbers
  lucida camera transforms.json#12 -o corner.toml
  lucida camera sparse/0 -o cameras.gltf
  lucida camera corner.toml --to opencv --size 1280x720"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("input", metavar="INPUT", help="a file or a folder")
    parser.add_argument("--to", metavar="FORMAT", help="write the camera in this format")
    parser.add_argument("-o", "--output", metavar="OUT", help="into this file (default: print it)")
    parser.add_argument(
        "--size",
        type=common.size,
        metavar="WxH",
        help="the image's size, instead of INPUT's; the viewport stays",
    )
    parser.add_argument(
        "--pixel-origin",
        choices=("center", "corner"),
        help="where pixel coordinates are whole numbers: at pixels' centres (OpenCV)\n"
        "or corners (default: each format's own)",
    )
    parser.add_argument("--no-lens", action="store_true", help="leave out the lens")
    parser.add_argument("--json", action="store_true", help="describe it as one JSON object")


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.files.cameras import Options, read_chosen, without_choice, written
    from lucida.renderer.files.cameras.given import given
    from lucida.renderer.files.reading import naming
    from lucida.renderer.system.atomic import atomic_write

    # Check for quick mistakes first.
    target = _target(arguments)
    file, which = without_choice(arguments.input)
    options = Options(arguments.pixel_origin, arguments.size)
    found, chosen = read_chosen(given(file), which, options, several=True)
    own = found.cameras if chosen is None else (chosen,)
    found = replace(found, cameras=tuple(_changed(arguments, c) for c in found.cameras))
    chosen = None if chosen is None else _changed(arguments, chosen)
    if target is None:
        print(_described(arguments, found, chosen))
        return 0
    with naming(file):
        data = written(found.cameras if chosen is None else (chosen,), target.name, options)
    if arguments.output is None:
        text = data.decode()
        sys.stdout.write(visible(text) if sys.stdout.isatty() else text)
    else:
        with atomic_write(arguments.output) as out:
            out.write(data)
        told = counted((len(own), "camera"))
        print(f"{one_line(arguments.output)}: {target.name}, {told}")
    say_notes(found, file)
    say_changes(own[0], arguments.size)
    return 0


def _described(arguments: argparse.Namespace, found: CameraSet, chosen: PosedCamera | None) -> str:
    from lucida.app.cameras.described import as_data, as_text, facts

    if arguments.json:
        return json.dumps(as_data(found, chosen), indent=2, allow_nan=False)
    told = facts(found, chosen)
    if chosen is None:
        name = next((camera.name for camera in found.cameras if camera.name), "")
        by_name = f", or INPUT#NAME, such as {name!r}" if name else ""
        told.append(("to choose", f"INPUT#N, 0 to {len(found.cameras) - 1}{by_name}"))
    return as_text(told)


def _target(arguments: argparse.Namespace) -> Format | None:
    """Return the format to write, from --to or OUT's ending; None for none. Raises LucidaError."""
    from lucida.renderer.files.cameras.formats import FORMATS, format_named

    if arguments.to is not None:
        with errors_as("--to"):
            target = format_named(arguments.to)
            target.check_written()
        return target
    if arguments.output is None:
        return None
    for entry in FORMATS:
        if Path(arguments.output).suffix.lower() in entry.endings:
            return entry
    names = ", ".join(entry.name for entry in FORMATS if entry.endings)
    raise LucidaError("--to", "is missing", f"give one of {names}")


def _changed(arguments: argparse.Namespace, posed: PosedCamera) -> PosedCamera:
    """Return a camera with the requested size, and without its lens if that was requested."""
    camera = posed.camera.pinhole if arguments.no_lens else posed.camera
    return replace(posed, camera=camera, size=arguments.size or posed.size)
