"""Random events in the driven window: keys, clicks, drops, layouts, lectures, sizes, sessions.

    python -m tools.attack random_events --minutes 10 --seed 7

After each event the state must still make a session (no NaN, nothing out of bounds), no view and no
renderer may have failed; now and then the window rests, where both images must agree and show
something, and memory must not have grown. A frame that hangs ends the run with all stacks. A run
that fails prints its seed and its last events; the same seed chooses the same events again, though
threads may answer at other frames.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
LAST = 25  # events that are told
SLACK_S = 300.0  # for the first compiling, and the end
VARIABLES = ("LUCIDA_ATTACK_SEED", "LUCIDA_ATTACK_MINUTES")  # event_drive.py reads them


def main(argv: Sequence[str]) -> int:
    """1 where the window did what it must not."""
    parser = argparse.ArgumentParser("random_events", description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, help="a random one where none is given")
    arguments = parser.parse_args(argv)
    seed = random.randrange(1 << 20) if arguments.seed is None else arguments.seed
    with tempfile.TemporaryDirectory(prefix="lucida-events-") as name:
        problem, events = _drive(Path(name), seed, arguments.minutes)
    print(
        f"random_events: seed {seed}, {len(events)} events, {(problem and 'FAILED') or 'all well'}"
    )
    if problem:
        print("The last events:", *events[-LAST:], sep="\n  ")
        print(problem)
    return 1 if problem else 0


def _drive(folder: Path, seed: int, minutes: float) -> tuple[str, list[str]]:
    """Return the problem, empty if there is none, and the events."""
    report, told = folder / "report.json", folder / "events.txt"
    hidden = ("DISPLAY", "WAYLAND_DISPLAY")
    variables = {k: v for k, v in os.environ.items() if k not in hidden}
    variables |= {
        "XDG_CONFIG_HOME": str(folder / "config"),
        "PYTHONPATH": os.pathsep.join((str(ROOT), str(ROOT / "tests" / "support"))),
        **dict(zip(VARIABLES, (str(seed), str(minutes)), strict=True)),
    }
    driver = ROOT / "tests" / "support" / "window_driver.py"
    try:
        done = subprocess.run(
            [sys.executable, driver, report, folder, Path(__file__).with_name("event_drive")],
            cwd=folder,
            env=variables,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=60.0 * minutes + SLACK_S,
        )
    except subprocess.TimeoutExpired:
        return "it did not end in time", _lines(told)
    results = json.loads(report.read_text()) if report.exists() else {}
    problem = "\n".join(text for text in results.values() if text)
    if done.returncode != 0 or not results:
        problem += f"\nexit status {done.returncode}\n{done.stdout[-1500:]}\n{done.stderr[-6000:]}"
    return problem.strip(), _lines(told)


def _lines(path: Path) -> list[str]:
    return path.read_text().splitlines() if path.exists() else []


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
