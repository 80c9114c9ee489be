"""The view "Your code" with its actions."""

from __future__ import annotations

from lucida.app.checking.your_code.panel import CodeWish
from lucida.app.checking.your_code.view import YOUR_CODE, YourCodeView
from lucida.app.ui import layout
from lucida.app.ui.action import Action
from lucida.app.ui.host import Host

MENU = "File/Your code"


def _ask(wish: CodeWish, window: Host) -> None:
    window.show_in(YOUR_CODE, layout.LOOPS)
    window.view(YourCodeView).ask(wish)


def _has_file(window: Host) -> bool:
    return bool(window.state.options.your_code.file)


YOURS = (
    Action(MENU, "Open Python code...", lambda window: _ask("open", window)),
    Action(MENU, "Write code to begin with...", lambda window: _ask("starter", window)),
    Action(MENU, "Open a course's tasks...", lambda window: _ask("tasks", window)),
    Action(
        MENU, "Run your code", lambda window: _ask("run", window), can=_has_file, separated=True
    ),
    Action(MENU, "Edit your code", lambda window: _ask("edit", window), can=_has_file),
)


class YourCode(YourCodeView):
    actions = YOURS
    synonyms = {
        "Your code": "python program student check homework viewing_ray",
        "Open Python code...": "student program .py your code",
        "Write code to begin with...": "starter template python",
        "Open a course's tasks...": "homework assignment exercise toml check your code",
        "Run your code": "check python again reload",
    }
