"""`lucida completion SHELL`: print the completion of commands, options and values for a shell."""

from __future__ import annotations

import argparse
from typing import Any

from . import view
from .arguments import Parser

NAME = "completion"

DESCRIPTION = "Print the completion of `lucida` for a shell: commands, options and their values."

EPILOG = """\
examples:
  bash     eval "$(lucida completion bash)"       in ~/.bashrc
  zsh      eval "$(lucida completion zsh)"        in ~/.zshrc, after compinit
  fish     lucida completion fish | source        in ~/.config/fish/config.fish
  tcsh     source ~/.lucida.tcsh                  in ~/.tcshrc, with that file from:
           lucida completion tcsh > ~/.lucida.tcsh"""

SHELLS = ("bash", "zsh", "fish", "tcsh")


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("shell", choices=SHELLS, help="the shell")


def run(arguments: argparse.Namespace) -> int:
    """Print the completion. arguments.commands: the modules of all commands."""
    import shtab

    class FileParser(Parser):
        """A parser whose words without fixed values are files."""

        def add_argument(self, *args: Any, **options: Any) -> argparse.Action:
            action = super().add_argument(*args, **options)
            if action.choices is None and action.nargs != 0:
                vars(action)["complete"] = shtab.FILE
            return action

    parser = FileParser(prog="lucida")
    commands = parser.add_subparsers(metavar="COMMAND")  # first: any other word is a scene
    view.configure(parser)
    for command in arguments.commands:
        command.configure(commands.add_parser(command.NAME, help=f"lucida {command.NAME}"))
    print(shtab.complete(parser, arguments.shell))
    if arguments.shell == "bash":  # complete files in place of a command, too
        print("complete -o default -F _shtab_lucida lucida")
    return 0
