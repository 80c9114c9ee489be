"""`lucida scenes`: the names of the built-in scenes."""

from __future__ import annotations

import argparse

NAME = "scenes"

EPILOG = """\
examples:
  lucida scenes                           the built-in scenes
  lucida render spheres -o spheres.png"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description = "List the built-in scenes, the default one first."
    parser.epilog = EPILOG


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.files import BUILTIN_SCENES

    print("\n".join(BUILTIN_SCENES))
    return 0
