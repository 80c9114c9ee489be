"""`lucida [SCENE]`: the window with both renderers side by side; `lucida rays.py`: with a student's
program.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from lucida import __version__
from lucida.app.cameras.options import CAMERA_OPTIONS, add_camera_options, with_camera_options

from .arguments import SCENE_HELP, size
from .given_camera import add_view_option, viewed

NAME = "view"
SMALLEST_SIDE = 64  # the least side of the window, in pixels
LARGEST_SHOWN = 1920 * 1200  # the most pixels of its images at the start

DESCRIPTION = """\
One camera, two renderers: a rasterizer (object order) and a ray tracer (image order)
draw the same scene from the same camera, side by side, while you drag the camera's numbers.

commands:
  lucida render SCENE -o OUT     draw one image into a file
  lucida animate SCENE -o OUT    draw a film: around the scene, or through key cameras
  lucida compare SCENE           compare the two images: counts, errors, causes
  lucida pick SCENE ROW COLUMN   report what a pixel sees: object, t, point, normal, colour
  lucida camera FILE             describe a camera of any format, or convert it
  lucida export SCENE -o OUT     write scene and camera as glTF
  lucida figure SCENE -o OUT     draw a figure: outside view, images or a pixel's formulas
  lucida page SCENE -o OUT.html  write the scene, live, as one HTML page
  lucida check FILE.py           check a student's code against the correct answers
  lucida tasks                   list the tasks for such code
  lucida lecture [FILE]          give a lecture, step by step
  lucida scene [SCENE]           list objects, bounds, triangles, lights and problems
  lucida doctor                  report what works here, and what to install
  lucida completion SHELL        complete commands and options in bash, zsh, fish or tcsh
`lucida COMMAND --help` says more. Open a scene file named like a command as ./render."""

EPILOG = """\
examples:
  lucida                                  the last session; at first, the built-in scene
  lucida bunny.obj                        a model, lit and framed
  lucida spheres --view corner.toml       a built-in scene, seen by another camera
  lucida spheres --eye=0,2,6              the scene's own camera, moved
  lucida rays.py                          your own viewing_ray, its picture next to the correct one
  lucida photo.jpg                        a photograph over the images, for matching a camera
  lucida transforms.json                  the cameras of a data set, or of a COLMAP model's folder
  lucida --screenshot window.png          draw the window once, save it, quit

With no display, lucida draws the window once, saves the picture and says where.
exit status: 0 done, 2 a mistake or a failure (one line says which), 130 interrupted"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=SCENE_HELP)
    parser.add_argument(
        "--screenshot", metavar="OUT.png", help="draw the whole window once, save it, quit"
    )
    add_view_option(parser)
    parser.add_argument(
        "--size", type=window_size, metavar="WxH", help="the window's size in pixels"
    )
    parser.add_argument("--fresh", action="store_true", help="do not restore the last session")
    add_camera_options(parser)
    parser.add_argument("--version", action="version", version=f"lucida {__version__}")


def window_size(text: str) -> tuple[int, int]:
    """Parse a window size with space for the images; without space, the window would wait for them
    forever.
    """
    width, height = size(text)
    if min(width, height) < SMALLEST_SIDE:
        raise argparse.ArgumentTypeError(
            f"{width}x{height} is too small for the window; "
            f"give at least {SMALLEST_SIDE}x{SMALLEST_SIDE}"
        )
    return width, height


def shown_size(own: tuple[int, int]) -> tuple[int, int]:
    """Return the size of the window's images, in the aspect ratio of the camera's own.

    A large size is divided by 2, 3, ..., so that the images follow the mouse.
    """
    parts = 1
    while own[0] * own[1] > LARGEST_SHOWN * parts * parts:
        parts += 1
    return max(1, round(own[0] / parts)), max(1, round(own[1] / parts))


def run(arguments: argparse.Namespace) -> int:
    from lucida.app.images.photograph.reading import found_photograph
    from lucida.app.instruments.poses.model import PoseSet
    from lucida.app.instruments.poses.reading import open_cameras
    from lucida.app.window.kinds import found_code, kind_of
    from lucida.renderer.images import check_image_path
    from lucida.renderer.scene.model import View

    from .arguments import check_is_scene

    screenshot = None
    if arguments.screenshot is not None:
        check_image_path(arguments.screenshot, (".png",))
        screenshot = Path(arguments.screenshot)
    any_camera = any(getattr(arguments, name) is not None for name in CAMERA_OPTIONS)
    code, photograph, cameras, view = "", "", None, None
    source: str | None = arguments.scene
    kind = kind_of(source) if source is not None else "scene"
    if source is not None and kind == "code":
        code, source = found_code(source), None
    elif source is not None and kind == "photograph":
        photograph, source = found_photograph(source), None
    elif source is not None and kind == "cameras":
        found = open_cameras(source)
        if isinstance(found, PoseSet):
            cameras = found
        else:
            view = found.view
        source = None
    elif source is not None:
        check_is_scene(source)
    posed = viewed(arguments)
    if posed is not None:
        view = View(posed.camera, posed.fit)
    from lucida.app.window.launch import run_viewer  # after the checks: it loads the window

    return run_viewer(
        source,
        screenshot,
        size=arguments.size,
        view=view,
        resolution=None if posed is None or posed.size is None else shown_size(posed.size),
        change=(lambda view: with_camera_options(arguments, view)) if any_camera else None,
        fresh=arguments.fresh,
        code=code,
        photograph=photograph,
        cameras=cameras,
    )
