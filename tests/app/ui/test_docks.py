"""Docks of a session: what ImGui would end the program over is not handed to it."""

from __future__ import annotations

import pytest

from lucida.app.ui.docks import are_sound

SPACE = "DockSpace ID=0x000000AA Window=0x01 Pos=0,24 Size=1278,638 Split=X\n"
LEFT = "  DockNode ID=0x00000001 Parent=0x000000AA SizeRef=312,638 Selected=0xAA49D574\n"
RIGHT = "  DockNode ID=0x00000002 Parent=0x000000AA SizeRef=965,638 CentralNode=1\n"
FLOATING = "DockNode ID=0x00000003 Pos=-60,60 Size=32,32 Selected=0x01\n"


def text(*lines: str) -> str:
    return "[Window][Camera]\nDockId=0x00000001,0\n\n[Docking][Data]\n" + "".join(lines) + "\n"


OWN = text(SPACE, LEFT, RIGHT)


def test_what_imgui_writes_is_sound() -> None:
    assert are_sound(OWN, OWN)
    assert are_sound(text(SPACE, LEFT, RIGHT, FLOATING), OWN)
    assert are_sound(text(SPACE.replace(" Split=X", " CentralNode=1")), OWN)


@pytest.mark.parametrize(
    "lines",
    [
        (),
        ("x\n",),
        (FLOATING,),
        (SPACE.replace("AA", "AB"), LEFT.replace("AA ", "AB "), RIGHT.replace("AA ", "AB ")),
        (SPACE, LEFT),
        (SPACE.replace(" Split=X", ""), LEFT, RIGHT),
        (SPACE, LEFT, RIGHT, LEFT.replace("01 ", "03 ")),
        (SPACE, LEFT, LEFT),
        (LEFT, SPACE, RIGHT),
        (SPACE, LEFT.replace("AA", "01"), RIGHT),
        (SPACE, LEFT, RIGHT.replace("02 ", "00 ")),
        (SPACE, LEFT.replace("SizeRef", "CentralNode=1 SizeRef"), RIGHT),
        (SPACE.replace("Split", "CentralNode=1 Split"), LEFT, RIGHT),
        (SPACE.replace("0x000000AA", "0xZZ"), LEFT, RIGHT),
    ],
)
def test_docks_that_are_no_tree_are_not_sound(lines: tuple[str, ...]) -> None:
    assert not are_sound(text(*lines), OWN)
