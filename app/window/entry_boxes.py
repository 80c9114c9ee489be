"""The boxes of the window to type a resolution or a pixel into, while they are open."""

from __future__ import annotations

from dataclasses import replace

from lucida.app.images.pair.boxes import EntryBox, pixel_box, resolution_box
from lucida.app.images.placement import shown_pixel
from lucida.app.images.renderers import Renderers
from lucida.app.state.app_state import AppState


class EntryBoxes:
    """size, pixel: the boxes to type a resolution or a pixel into; None: closed."""

    def __init__(self) -> None:
        self.size: EntryBox | None = None
        self.pixel: EntryBox | None = None

    @property
    def focused(self) -> bool:
        """Return True if a box has the keyboard.

        Its digits are no bookmarks, even before the field that Tab has gone to takes them.
        """
        return any(box.focused for box in (self.size, self.pixel) if box is not None)

    def close(self) -> bool:
        """Close the boxes; return whether any was open."""
        were_open = self.size is not None or self.pixel is not None
        self.size = self.pixel = None
        return were_open

    def draw(self, state: AppState, renderers: Renderers) -> AppState:
        """Draw the open boxes. Return the state with what was entered.

        A pixel that was entered is marked, and brought into sight if the images are magnified.
        """
        if self.size is not None:
            self.size, state = resolution_box(self.size, state)
        if self.pixel is not None:
            self.pixel, pixel = pixel_box(self.pixel, state)
            if pixel is not None:
                placement = renderers.placement(state)
                state = state.with_options(replace(state.options, marked=pixel))
                if placement is not None:
                    state = state.with_options(shown_pixel(state.images, placement, pixel))
        return state
