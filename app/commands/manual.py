"""The man page of `lucida`, made of what --help says of each command.

`lucida install-desktop` installs it.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping

from app import __version__

PURPOSE = "how a camera turns a 3D world into an image"
WIDTH = 72  # columns; man indents them by 7


def man_page(parsers: Mapping[str, argparse.ArgumentParser]) -> str:
    """Return the page as man(7) reads it.

    parsers: of each command by its name; that of the window is "".
    """
    lines = [f'.TH LUCIDA 1 "" "Lucida {__version__}" "User Commands"']
    lines += [".SH NAME", rf"lucida \- {PURPOSE}"]
    for name, parser in parsers.items():
        parser.formatter_class = lambda prog: argparse.RawTextHelpFormatter(prog, width=WIDTH)
        title = f'"LUCIDA {name.upper()}"' if name else "SYNOPSIS"
        lines += [f".SH {title}", ".nf", _escaped(parser.format_help()), ".fi"]
    return "\n".join(lines) + "\n"


def _escaped(text: str) -> str:
    """Return text in which roff finds no request and no escape, and keeps hyphens to be copied."""
    text = text.strip().replace("\\", r"\e").replace("-", r"\-")
    return re.sub(r"^(?=[.'])", r"\&", text, flags=re.MULTILINE)
