"""The parts that commands for many pictures share: the workers' options and the drawing itself.

It is quick to import.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from lucida.renderer.system.errors import one_line

from . import arguments as common

if TYPE_CHECKING:
    from lucida.app.cameras.films.film import Film
    from lucida.app.cameras.films.frames import Look


def add_workers_options(parser: argparse.ArgumentParser, what: str) -> None:
    """Add --workers and --scheduler. what: the pictures, in words."""
    parser.add_argument(
        "--workers",
        type=common.whole(1, 1024, "is not a number of workers; give 1 to 1024"),
        default=1,
        metavar="N",
        help=f"processes that draw {what}\nside by side (default: 1)",
    )
    parser.add_argument("--scheduler", default="", metavar="ADDRESS", help="Dask's, for a cluster")


def look_of(arguments: argparse.Namespace) -> Look:
    """Return the settings of the options of add_drawing_options()."""
    from lucida.app.cameras.films.frames import Look

    return Look(
        arguments.renderer,
        arguments.samples,
        arguments.shadows,
        arguments.mirrors,
        arguments.exposure,
        arguments.backend,
    )


def make_film(film: Film, arguments: argparse.Namespace, what: str) -> None:
    """Draw what is missing, with a progress bar. what: the pictures, in words. Raises
    LucidaError.
    """
    from lucida.app.cameras.films.film import begin, make

    done = begin(film)
    if done:
        there = "all" if done == len(film.shots) else f"{done} of"
        where = f"lucida: {one_line(str(film.folder))}"
        print(f"{where}: {there} {len(film.shots)} {what} are there; delete them to redraw")
    with common.progress_bar(what) as progress:
        make(film, arguments.workers, arguments.scheduler, progress)
