"""Try the tests' properties with random examples: `make test` repeats its own.

    python -m tools.attack properties --seed 3 --minutes 4

A property that fails is shown with its smallest example and with the seed that repeats it.
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
PLANTED = """
from hypothesis import given, strategies

@given(strategies.integers())
def test_planted(number):
    assert number < 1000
"""


def main(argv: Sequence[str]) -> int:
    """Return 1 where a property fails, or where one that is false is not noticed."""
    parser = argparse.ArgumentParser("properties", description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--seed", type=int, help="a random one where none is given")
    parser.add_argument("--minutes", type=float, help="no further file after that")
    arguments = parser.parse_args(argv)
    seed = random.randrange(1 << 20) if arguments.seed is None else arguments.seed
    with tempfile.TemporaryDirectory(prefix="lucida-attack-") as folder:
        planted = Path(folder) / "test_planted.py"
        planted.write_text(PLANTED)
        if run(seed, None, str(planted), stdout=subprocess.DEVNULL) != 1:
            print("properties: a property that is false is not noticed")
            return 1
    tests = sorted(ROOT.glob("tests/**/test_*.py"))
    files = [str(path) for path in tests if "from hypothesis import" in path.read_text("utf-8")]
    random.Random(seed).shuffle(files)
    status = run(seed, arguments.minutes, "--hypothesis-profile=attack", "-n", "auto", *files)
    print(f"properties: seed {seed}, {'FAILED' if status else 'all well'}")
    return int(status != 0)


def run(seed: int, minutes: float | None, *arguments: str, stdout: int | None = None) -> int:
    """Return pytest's exit status; 0 where the time was over before anything failed."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-x"]
    command += [f"--hypothesis-seed={seed}", *arguments]
    limit_s = None if minutes is None else 60 * minutes
    try:
        return subprocess.run(command, cwd=ROOT, stdout=stdout, timeout=limit_s).returncode
    except subprocess.TimeoutExpired:
        return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
