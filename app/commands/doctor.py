"""`lucida doctor`: check what this computer lets Lucida do (renderer/system/doctor.py)."""

from __future__ import annotations

import argparse
import platform
from typing import TYPE_CHECKING

from lucida import __version__

if TYPE_CHECKING:
    from lucida.renderer.system.doctor import Check

NAME = "doctor"

DESCRIPTION = """\
Report which parts of Lucida work on this machine, and why others do not and what to install:
OpenGL, display, ray tracer, the packages of films and notebooks, the command and the imports."""

EPILOG = """\
example:
  lucida doctor

exit status: 0 at least one OpenGL platform works, 1 none does"""


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG


def run(arguments: argparse.Namespace) -> int:
    from lucida.renderer.system.doctor import can_draw, report

    checks = report()
    usable = can_draw(checks)
    print(as_text(checks, usable))
    return 0 if usable else 1


def as_text(checks: list[Check], usable: bool) -> str:
    """Return the report as text: a line for each check, and a line with the remedy if it fails."""
    lines = [f"lucida {__version__}, Python {platform.python_version()}, {_system()}", ""]
    for check in checks:
        mark = "works" if check.works else "no"
        lines.append(f"{check.name:9} {mark:6} {check.purpose}: {check.detail}")
        if check.remedy:
            lines.append(f"{'':16} {check.remedy}")
    if not usable:
        lines += ["", "No OpenGL platform works: only the ray tracer can draw."]
    return "\n".join(lines)


def _system() -> str:
    return f"{platform.system()} {platform.release()} {platform.machine()}"
