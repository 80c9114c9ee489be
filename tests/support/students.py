"""The questions to students' code."""

from __future__ import annotations

from lucida.app.checking.tasks import Call

CAMERA = {
    "eye": [0.0, 0.0, 5.0],
    "u": [1.0, 0.0, 0.0],
    "v": [0.0, 1.0, 0.0],
    "w": [0.0, 0.0, 1.0],
    "distance": 1.0,
    "left": -1.0,
    "right": 1.0,
    "bottom": -0.75,
    "top": 0.75,
    "projection": "perspective",
}


def called(function: str, /, **arguments) -> Call:
    return Call(function, tuple(arguments.items()))
