"""The palettes: dark and light, each also for presentation.

The colour language is the same in all of them: u, v, w after Okabe and Ito, rays in orange, hits
and the marked pixel in yellow.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from imgui_bundle import ImVec4


def rgb(text: str, alpha: float = 1.0) -> ImVec4:
    """Parse `#d55e00` as a colour."""
    red, green, blue = (int(text[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return ImVec4(red, green, blue, alpha)


@dataclass(frozen=True, eq=False)
class Palette:
    """The colours of a theme.

    ACCENT, FILL: the outline of the selection, and its background under text.
    LIT: the background of a highlight in a formula or a program.
    LINE_WIDTH: the factor for the width of lines that teach.
    """

    BASIS: dict[str, ImVec4]
    RAY: ImVec4
    MARK: ImVec4
    PLAIN: ImVec4
    TEXT: ImVec4
    DIM: ImVec4
    ERROR: ImVec4
    GOOD: ImVec4
    BACKGROUND: ImVec4
    PANEL: ImVec4
    POPUP: ImVec4
    FRAME: ImVec4
    FRAME_HOVERED: ImVec4
    FRAME_ACTIVE: ImVec4
    LINE: ImVec4
    ACCENT: ImVec4
    FILL: ImVec4
    LIT: ImVec4
    LINE_WIDTH: float = 1.0

    def changed(self, u: str, v: str, w: str, **colors: str) -> Palette:
        """Return a palette with other colours. u, v, w: the basis vectors' colours."""
        basis = {"u": rgb(u), "v": rgb(v), "w": rgb(w)}
        parts: dict[str, Any] = {name: rgb(text) for name, text in colors.items()}
        return replace(self, BASIS=basis, **parts)


# The colours of the red, green and blue channels; legible() adapts them for text.
CHANNELS = (rgb("#e5484d"), rgb("#46a758"), rgb("#4f8ff7"))

_BLACK: Any = [rgb("#000000")] * 17
_NONE = Palette({}, *_BLACK)
# Okabe and Ito's colours; blue is lightened to stand out from the dark background.
DARK = _NONE.changed(
    *("#d55e00", "#009e73", "#3f9be0"),
    RAY="#e69f00",
    MARK="#f0e442",
    PLAIN="#9aa3ad",
    TEXT="#e8eaed",
    DIM="#a3abb5",
    ERROR="#ff8aa3",
    GOOD="#35c497",
    BACKGROUND="#16181b",
    PANEL="#1e2125",
    POPUP="#24282d",
    FRAME="#2b3036",
    FRAME_HOVERED="#373d45",
    FRAME_ACTIVE="#434b55",
    LINE="#3a4048",
    ACCENT="#56779a",
    FILL="#4d6a86",
    LIT="#3d3200",
)
LIGHT = DARK.changed(
    *("#d55e00", "#008a64", "#0072b2"),
    PLAIN="#717a84",
    TEXT="#16191c",
    DIM="#545c65",
    ERROR="#a80037",
    GOOD="#00664a",
    BACKGROUND="#d9dde1",
    PANEL="#f6f7f8",
    POPUP="#ffffff",
    FRAME="#e2e6ea",
    FRAME_HOVERED="#d2d8de",
    FRAME_ACTIVE="#bfc8d1",
    LINE="#b9c0c8",
    ACCENT="#3d78ad",
    FILL="#a9cbe6",
    LIT="#f2db84",
)
# Projectors reduce contrast: use the ends of the scale, and brighter colours.
PRESENTED_DARK = replace(DARK, LINE_WIDTH=2.0).changed(
    *("#ff7a1a", "#1fc795", "#56b4e9"),
    RAY="#ffb000",
    TEXT="#ffffff",
    DIM="#d0d5db",
    BACKGROUND="#000000",
    PANEL="#0e1012",
    LINE="#68717c",
)
PRESENTED_LIGHT = replace(LIGHT, LINE_WIDTH=2.0).changed(
    *("#c24e00", "#00704f", "#005c94"),
    TEXT="#000000",
    DIM="#33393f",
    BACKGROUND="#e8ebee",
    PANEL="#ffffff",
    LINE="#8b949e",
)
