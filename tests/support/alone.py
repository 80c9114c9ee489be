"""A view that has the window for itself while it is driven: for several topics of drives."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass
from typing import Generic

from window_driver import Driver

from lucida.app.ui import layout
from lucida.app.ui.instrument import AnInstrument


@dataclass(frozen=True)
class Alone(Generic[AnInstrument]):
    """kind: the view's class. options: what its options are called in the state."""

    kind: type[AnInstrument]
    options: str

    def open(self, d: Driver, **options: object) -> AnInstrument:
        """Shows the view, alone, with these options."""
        show_only(d, [self.kind.name])
        d.change(**{self.options: options})
        d.settle()
        return d.window.view(self.kind)

    def close(self, d: Driver) -> None:
        show_only(d, layout.current().places)
        d.settle()

    def item(self, name: str) -> str:
        return f"//###{self.kind.name}/{name}"


def show_only(d: Driver, names: Container[str]) -> None:
    """Hide all views but these."""
    for name, view in d.stage.views.items():
        layout.window_of(view).is_visible = name in names
    d.frames(2)
