"""`lucida doctor`: what works on this machine."""

from __future__ import annotations

import argparse

NAME = "doctor"


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description = "x"


def run(arguments: argparse.Namespace) -> int:
    return 0
