"""`lucida`, and `python -m app`.

Owns the process until the command line is there: imports take a while, and Ctrl-C may come.
"""

import os
import sys
from typing import NoReturn

INTERRUPTED = 130  # as shells tell SIGINT


def main() -> int:
    """Runs `lucida` with the process's arguments; gives the exit status (app/cli.py)."""
    # For libraries that start Python, as glfw does: not to search the current folder for modules.
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        from app.window import process, quick_start

        process.interrupt_between_imports()
        quick_start.begin()
        from app.cli import main as run

        process.interrupt_after_imports()
        status = run()
        process.interrupt_at_once()
        return status
    except KeyboardInterrupt:
        return INTERRUPTED


def leave_current_folder() -> None:
    """`python -m` looks for modules in the current folder first: only if this one is from there."""
    here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    if not sys.flags.safe_path and os.path.realpath(sys.path[0]) != os.path.realpath(here):
        del sys.path[0]


def main_to_the_end() -> NoReturn:
    """main(), and then the process ends at once."""
    status = main()
    from app.window import quick_start

    quick_start.end(status)


if __name__ == "__main__":
    leave_current_folder()
    main_to_the_end()
