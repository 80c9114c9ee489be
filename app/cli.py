"""The command line: selects the command, and reports how it ended.

This includes the exit status and the one line of an error. Each command imports the heavy modules
that it needs, so that `--help` and `--version` answer at once.
"""

from __future__ import annotations

import os
import re
import shlex
import signal
import sys
import traceback
from collections.abc import Sequence

from lucida.renderer.system.errors import LucidaError, one_line, shortened

from .commands import COMMANDS, view
from .commands.arguments import TRACEBACK_VARIABLE, Parser
from .window.process import open_streams

FAILED = 2
INTERRUPTED = 128 + signal.SIGINT
# Commands and options that left, and what to use instead.
LEFT = {
    "install-desktop": "start lucida in a terminal",
    "scenes": "`lucida scene` lists the built-in scenes",
    "--enlargement": "Rasterizer.render(enlargement=4) in Python has it",
    "--ignore-distortion": "--lens none takes a lens off, in `lucida camera` --no-lens",
    "--time-limit": "a task file has it: seconds = 60",
    "--memory-limit": "a task file has it: memory_mb = 2048",
    "--frames": "a film has --seconds times --fps of them",
    "--threads": "Tracer(scene, threads=4) in Python has it",
    "--from": "commands count rows and columns from 0",
    "--show": "`lucida compare` marks the causes; the window's view Compare shows the difference",
    "--photographs": "`lucida render --view SET#1 -o OUT` draws one camera of a set; a loop, all",
    "--all": "`lucida render --view SET#1 -o OUT` draws one camera of a set; a loop, all",
    "--undistort": "COLMAP's image_undistorter undistorts the photographs of a data set",
}
BROKEN_PIPE = 128 + 13  # SIGPIPE, which Windows does not have


def main(argv: Sequence[str] | None = None) -> int:
    """Run `lucida` with these arguments (default: the process's). Return the exit status.

    0: done. 1: the command's answer is no (compare: the renderers disagree; doctor: nothing works).
    2: a mistake in the arguments or files, or a failure. 130: interrupted by Ctrl-C.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    open_streams()
    try:
        status = _dispatch(arguments)
        sys.stdout.flush()
        return status
    except SystemExit as end:  # argparse: --help, --version, or a mistake that it reported
        return end.code if isinstance(end.code, int) else FAILED
    except KeyboardInterrupt:
        _say("interrupted")
        return INTERRUPTED
    except BrokenPipeError:
        _discard_output()  # the reader closed the pipe, like `head`
        return BROKEN_PIPE
    except LucidaError as error:
        return _failed(str(error))
    except MemoryError:
        return _failed("not enough memory; try a smaller image or model")
    except OSError as error:
        _discard_output()
        where = f"{error.filename}: " if error.filename else ""
        return _failed(f"{where}{error.strerror or error}")
    except Exception as error:
        what = one_line(f"{type(error).__name__} {error}")
        return _failed(f"internal error: {what}; {TRACEBACK_VARIABLE}=1 shows where, for a report")


def _dispatch(arguments: list[str]) -> int:
    _check_has_not_left(arguments)
    command = next((c for c in COMMANDS if arguments[:1] == [c.NAME]), view)
    if command is view:
        _check_is_no_command(arguments)
    arguments = arguments if command is view else arguments[1:]
    parser = Parser(prog="lucida" if command is view else f"lucida {command.NAME}")
    command.configure(parser)
    parser.set_defaults(commands=COMMANDS)  # for the completion, which describes all of them
    return int(command.run(parser.parse_args(arguments)))


def _check_has_not_left(arguments: list[str]) -> None:
    """Raise LucidaError for a command or an option of an earlier version."""
    for argument in arguments:
        name = argument.partition("=")[0]
        if name in LEFT and (name.startswith("-") or argument is arguments[0]):
            raise LucidaError(name, "is no longer part of Lucida", LEFT[name])


def _check_is_no_command(arguments: list[str]) -> None:
    """Raise LucidaError if the first argument looks like a misspelt command rather than a scene."""
    name = arguments[0] if arguments else ""
    if not re.fullmatch(r"[A-Za-z_][A-Za-z_-]*", name) or os.path.lexists(name):
        return
    from lucida.renderer.files.load import BUILTIN_SCENES
    from lucida.renderer.files.reading import close_matches

    commands = [command.NAME for command in COMMANDS]
    close = close_matches(name, [*BUILTIN_SCENES, *commands])
    if close and close[0] in commands:
        meant = shortened(shlex.join(["lucida", close[0], *arguments[1:]]), 200)
        remedy = f"did you mean {meant}?"
    elif name not in BUILTIN_SCENES and arguments[1:] and not arguments[1].startswith("-"):
        remedy = "see 'lucida --help'"
    else:
        return
    raise LucidaError("", f"{name!r} is neither a command nor a scene", remedy)


def _failed(message: str) -> int:
    if os.environ.get(TRACEBACK_VARIABLE):
        traceback.print_exc()
    _say(message)
    return FAILED


def _say(message: str) -> None:
    print(f"lucida: {one_line(message)}", file=sys.stderr)


def _discard_output() -> None:
    """Discard the output, so that Python's own flush at exit does not fail."""
    try:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, sys.stdout.fileno())
        os.close(null)
    except (OSError, ValueError):
        pass  # stdout is not a file, as in a test
