"""`lucida completion SHELL`: the commands, options and values that a shell completes.

Made from the commands' parsers.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator, Mapping

NAME = "completion"

DESCRIPTION = "Print the completion of `lucida` for a shell: commands, options and their values."

EPILOG = """\
`lucida install-desktop` puts bash's and fish's where these shells look for them.

examples, by hand:
  bash     eval "$(lucida completion bash)"       in ~/.bashrc
  zsh      eval "$(lucida completion zsh)"        in ~/.zshrc, after compinit
  fish     lucida completion fish | source        in ~/.config/fish/config.fish"""

SHELLS = ("bash", "zsh", "fish")

_BASH = """\
_lucida() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
    local command= words hidden='-*'
    [ "$COMP_CWORD" = 1 ] || command=${{COMP_WORDS[1]}}
    case $command in
{commands}
    esac
    case $command/$before in
{values}
    esac
    [[ $word != -* ]] || hidden=
    COMPREPLY=($(compgen -X "$hidden" -W "$words" -- "$word"))
}}
complete -o default -F _lucida lucida
"""
_ZSH = "autoload -U +X bashcompinit && bashcompinit\n"

Parsers = Mapping[str, argparse.ArgumentParser]


def configure(parser: argparse.ArgumentParser) -> None:
    parser.description, parser.epilog = DESCRIPTION, EPILOG
    parser.add_argument("shell", choices=SHELLS, help="the shell")


def run(arguments: argparse.Namespace) -> int:
    print(completion(arguments.shell, arguments.parsers()), end="")
    return 0


def completion(shell: str, parsers: Parsers) -> str:
    """Return the script for one of SHELLS. The shell completes all other words as files.

    parsers: of each command by its name; that of the window is "".
    """
    if shell == "fish":
        return "".join(f"{line}\n" for line in _fish(parsers))
    return (_ZSH if shell == "zsh" else "") + _bash(parsers)


def _bash(parsers: Parsers) -> str:
    commands, values = [], []
    # The window's parser comes last: any word but a command is its scene.
    for name, parser in sorted(parsers.items(), reverse=True):
        words = [] if name else [*filter(None, parsers), *_scenes()]
        for action in parser._actions:
            words += action.option_strings or _words(action.choices)
            if action.option_strings and action.choices:
                keys = "|".join(f"{name or '*'}/{option}" for option in action.option_strings)
                values.append(f'        {keys}) words="{" ".join(_words(action.choices))}" ;;')
        commands.append(f'        {name or "*"}) words="{" ".join(words)}" ;;')
    return _BASH.format(commands="\n".join(commands), values="\n".join(values))


def _fish(parsers: Parsers) -> Iterator[str]:
    names = " ".join(filter(None, parsers))
    for name, parser in parsers.items():
        seen = "__fish_seen_subcommand_from"
        where = f"{seen} {name}" if name else f"not {seen} {names}"
        if name:
            about = _line(parser.description)
            yield f"complete -c lucida -n __fish_use_subcommand -a {name} -d {about}"
        for action in parser._actions:
            if not (action.option_strings or action.choices):
                continue  # a file
            line = f"complete -c lucida -n '{where}' -d {_line(action.help)}"
            for option in action.option_strings:
                line += f" -l {option[2:]}" if option[:2] == "--" else f" -s {option[1:]}"
            if action.choices:
                line += f" -x -a '{' '.join(_words(action.choices))}'"
            elif action.nargs != 0:
                line += " -r"
            yield line
    yield f"complete -c lucida -n __fish_use_subcommand -a '{' '.join(_scenes())}' -d scene"


def _scenes() -> tuple[str, ...]:
    from renderer.scene.load import BUILTIN_SCENES

    return BUILTIN_SCENES


def _words(choices: Iterable[object] | None) -> list[str]:
    return [str(choice) for choice in choices or ()]


def _line(text: str | None) -> str:
    """Return the first line of a text, quoted for fish."""
    first = (text or "").partition("\n")[0].replace("\\", "\\\\").replace("'", "\\'")
    return f"'{first}'"
