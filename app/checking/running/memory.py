"""How much memory a process and those that it started hold."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path


def memory_of(process: int) -> int:
    """In bytes; 0 where it has ended, and where nobody can tell."""
    if sys.platform != "linux":
        return told_by_system(process)
    tree = tree_of(process)
    held = sum(map(_resident, tree))
    # Copies share most of what they hold: counting that exactly takes longer.
    return held if len(tree) == 1 or held < 1 << 28 else sum(map(_proportional, tree))


def told_by_system(process: int) -> int:
    """Bytes of a process, as `ps` or `tasklist` tells; 0 where it is gone."""
    command = ["ps", "-o", "rss=", "-p", str(process)]
    if sys.platform == "win32":
        command = ["tasklist", "/FI", f"PID eq {process}", "/FO", "CSV", "/NH"]
    try:
        printed = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError:
        return 0
    digits = "".join(sign for sign in printed.strip().rpartition(',"')[2] if sign.isdigit())
    return int(digits or 0) << 10


def tree_of(process: int) -> list[int]:
    """A process and all below it. Linux."""
    tree = [process]
    for number in tree:
        try:
            for children in Path(f"/proc/{number}/task").glob("*/children"):
                tree += map(int, children.read_text().split())
        except OSError:
            continue
    return tree


def _resident(process: int) -> int:
    try:
        return int(Path(f"/proc/{process}/statm").read_text().split()[1]) * os.sysconf(
            "SC_PAGESIZE"
        )
    except (OSError, IndexError):
        return 0


def _proportional(process: int) -> int:
    try:
        for line in Path(f"/proc/{process}/smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1]) << 10
    except OSError:
        pass
    return 0
