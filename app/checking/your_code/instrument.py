"""The view "Your code" with its actions."""

from __future__ import annotations

from lucida.app.checking.your_code.actions import YOURS
from lucida.app.checking.your_code.view import YourCodeView


class YourCode(YourCodeView):
    actions = YOURS
    synonyms = {
        "Your code": "python program student check homework viewing_ray",
        "Open Python code...": "student program .py your code",
        "Write code to begin with...": "starter template python",
        "Open a course's tasks...": "homework assignment exercise toml check your code",
        "Run your code": "check python again reload",
        "Stop your code": "endless loop kill",
    }
