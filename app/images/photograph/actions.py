"""The photograph's actions."""

from __future__ import annotations

from lucida.app.ui.action import Action, changing, choosing
from lucida.app.ui.host import Host

from .model import closed

MENU = "Image/Photograph"
OPACITIES = (0.25, 0.5, 0.75, 1.0)  # means of what the screen shows (sRGB), not of light


def is_open(window: Host) -> bool:
    """Return True if there is a photograph for the images."""
    return bool(window.state.options.photograph.file)


PHOTOGRAPH = (
    choosing(
        MENU,
        "Photograph on the images",
        "photograph.shown",
        True,
        "Alt+P",
        off=False,
        can=is_open,
    ),
    *(
        choosing(
            MENU,
            f"Opacity {opacity:.0%}",
            "photograph.opacity",
            opacity,
            can=is_open,
            separated=opacity == OPACITIES[0],
        )
        for opacity in OPACITIES
    ),
    Action(MENU, "Close the photograph", changing(closed), can=is_open, separated=True),
)
