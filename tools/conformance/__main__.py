"""python -m tools.conformance: holds the formats of cameras against the real programs."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from lucida.renderer.files.cameras import FORMATS
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError
from tools.conformance import report
from tools.conformance.run import outcomes

ROOT = Path(__file__).resolve().parents[2]
FORMAT_NAMES = [entry.name for entry in FORMATS]
LEAST = 1000  # cameras, for what is written into the pages


def main(argv: list[str] | None = None) -> int:
    """The command line; gives the exit status: 2 for a user's mistake, 1 where anything is beyond
    its bound or could not be checked to its end."""
    arguments = _parser().parse_args(argv)
    try:
        return _run(arguments)
    except LucidaError as error:
        print(f"conformance: {error}", file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="make conformance ARGS=...", description=__doc__)
    parser.add_argument("--count", type=int, default=LEAST, help="cameras a check")
    parser.add_argument("--only", help=f"comma-separated: {','.join(FORMAT_NAMES)}")
    parser.add_argument(
        "--document", action="store_true", help="write the tables into docs/cameras.md"
    )
    return parser


def _run(arguments: argparse.Namespace) -> int:
    names = _chosen(arguments.only)
    if arguments.count < 1:
        raise LucidaError("--count", f"{arguments.count} is not above 0", "give e.g. 1000")
    if arguments.document and (arguments.only is not None or arguments.count < LEAST):
        problem = "needs all formats, and 1000 cameras"
        raise LucidaError("--document", problem, "leave out --only and --count")
    found = []
    for outcome in outcomes(names, arguments.count):
        print(report.text(outcome), flush=True)
        found.append(outcome)
    beyond = [outcome.format for outcome in found if not outcome.met]
    if beyond:
        print(f"conformance: not as it should be: {', '.join(beyond)}", file=sys.stderr)
        return 1
    if arguments.document:
        _document(found, arguments.count)
    return 0


def _chosen(only: str | None) -> list[str]:
    names = FORMAT_NAMES if only is None else only.split(",")
    for name in names:
        if name not in FORMAT_NAMES:
            remedy = f"give one of {', '.join(FORMAT_NAMES)}"
            raise LucidaError("--only", f"{name!r} is unknown", remedy)
    return names


def _document(found: list[report.Outcome], count: int) -> None:
    path = ROOT / "docs" / "cameras.md"
    block = report.page(found, count)
    text = report.between_marks(path.read_text(encoding="utf-8"), block, path.name)
    with atomic_write(path) as file:
        file.write(text.encode())
    print(path)


if __name__ == "__main__":
    sys.exit(main())
