"""python -m tools.benchmarks: measures, prints the tables, writes JSON."""

from __future__ import annotations

import argparse
import sys
import traceback
from pathlib import Path

from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError
from tools.benchmarks import report
from tools.benchmarks.run import Run
from tools.benchmarks.tables import TABLES

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "out" / "bench"
UNDOCUMENTED = "hard views"  # only its targets


def main(argv: list[str] | None = None) -> int:
    """The command line; gives the exit status: 2 for a user's mistake, 1 if a table failed."""
    arguments = _parser().parse_args(argv)
    try:
        return _run(arguments)
    except LucidaError as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="make bench ARGS=...", description=__doc__)
    parser.add_argument("--only", help=f"comma-separated: {','.join(TABLES)}")
    parser.add_argument("--quick", action="store_true", help="small scenes, few rounds")
    parser.add_argument("--model", type=Path, metavar="FILE", help="measure this mesh instead")
    parser.add_argument("--out", type=Path, default=OUT, metavar="FOLDER")
    parser.add_argument("--no-peers", action="store_true", help="Lucida alone")
    parser.add_argument(
        "--document", action="store_true", help="write the tables into docs/speed.md"
    )
    return parser


def _run(arguments: argparse.Namespace) -> int:
    names = _chosen(arguments.only)
    if arguments.document and arguments.only is not None:
        raise LucidaError("--document", "needs all tables", "leave out --only")
    run = Run(arguments.quick, arguments.model)
    try:
        return _measured(run, names, arguments)
    finally:
        run.close()


def _measured(run: Run, names: list[str], arguments: argparse.Namespace) -> int:
    if not arguments.no_peers:
        run.say("looking for the peers")
        run.find_peers()
    machine = report.machine()
    print(f"{machine['cpu']}, {machine['processors']} processors, Python {machine['python']}")
    if (machine["load"] or 0) > 0.5 * machine["processors"]:
        print(f"the machine is busy (load {machine['load']:.1f}): the times below are unreliable")
    for name, version in run.versions.items():
        print(f"{name}: {version}")
    for name, why in run.left_out.items():
        print(f"{name} is left out: {why}")
    print()
    tables: list[report.Table] = []
    failed = stopped = False
    try:
        for name in names:
            try:
                made = TABLES[name](run)
            except LucidaError:
                raise
            except Exception:  # the other tables are still worth having
                traceback.print_exc()
                failed = True
                continue
            tables += made
            for table in made:
                print(report.text(table), flush=True)
    except KeyboardInterrupt:
        run.say("stopped; what was measured is written")
        stopped = True
    print(report.text(report.losses(tables)))
    print(report.text(report.targets(tables, missed=True)), flush=True)
    machine["load_after"] = report.load()
    settings = {"quick": run.quick, "model": run.file and str(run.file)}
    arguments.out.mkdir(parents=True, exist_ok=True)
    with atomic_write(arguments.out / "bench.json") as file:
        text = report.as_json(
            tables, machine=machine, settings=settings, peers=run.versions, left_out=run.left_out
        )
        file.write(text.encode())
    print(arguments.out / "bench.json")
    if arguments.document:
        if failed or stopped:
            why = "a table failed" if failed else "was stopped"
            raise LucidaError("--document", why, "docs/speed.md is as it was; start again")
        _document(run, machine, tables)
    return int(failed)


def _chosen(only: str | None) -> list[str]:
    names = list(TABLES) if only is None else only.split(",")
    for name in names:
        if name not in TABLES:
            raise LucidaError("--only", f"{name!r} is unknown", f"give one of {', '.join(TABLES)}")
    return names


def _document(run: Run, machine: dict, tables: list[report.Table]) -> None:
    """Put the tables between the marks of docs/speed.md."""
    peers = ", ".join(f"{name} {version}" for name, version in run.versions.items())
    parts = [
        f"`make bench` on {machine['cpu']}, {machine['processors']} processors, Python "
        f"{machine['python']}, numba {machine['packages']['numba']}; "
        f"compared with {peers or 'none'}. Each tracer has its own process; they take turns, with "
        "three calls after a pause of 20 ms. "
        "Times are medians in ms; in brackets, relative to Lucida.",
        *(report.markdown(table) for table in tables if table.name != UNDOCUMENTED),
        report.markdown(report.losses(tables)),
        report.markdown(report.targets(tables)),
    ]
    block = "\n\n".join(part.strip() for part in parts)
    page = ROOT / "docs" / "speed.md"
    text = report.between_marks(page.read_text(encoding="utf-8"), block)
    with atomic_write(page) as file:
        file.write(text.encode())


if __name__ == "__main__":
    sys.exit(main())
