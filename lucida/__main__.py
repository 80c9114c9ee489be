"""`lucida`, and `python -m lucida`.

Runs the process until the command line is imported, which takes a while: Ctrl-C may come earlier.
"""

import os
import sys

INTERRUPTED = 130  # shells' exit status for SIGINT


def main() -> int:
    """Run `lucida` with the process's arguments. Return the exit status (app/cli.py)."""
    # Keeps libraries that start Python, such as glfw, from importing from the current folder.
    os.environ["PYTHONSAFEPATH"] = "1"
    # The matrices here are small: waking other threads takes longer than multiplying.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        from lucida.app.window import process

        process.end_by_interrupt(at_once=True)
        from lucida.app.cli import main as run

        process.end_by_interrupt(at_once=False)
        status = run()
        process.end_by_interrupt(at_once=True)
        return status
    except KeyboardInterrupt:
        return INTERRUPTED


def leave_current_folder() -> None:
    """Remove the current folder from the search path, where `python -m` looks first, unless this
    module is from there.
    """
    here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    if not sys.flags.safe_path and os.path.realpath(sys.path[0]) != os.path.realpath(here):
        del sys.path[0]


if __name__ == "__main__":
    leave_current_folder()
    sys.exit(main())
