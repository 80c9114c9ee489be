"""A view that covers all others while it is driven: for several topics of drives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

from window_driver import Driver

from lucida.app.ui.instrument import AnInstrument


@dataclass(frozen=True)
class Maximised(Generic[AnInstrument]):
    """kind: the view's class. options: what its options are called in the state."""

    kind: type[AnInstrument]
    options: str

    def open(self, d: Driver, **options: object) -> AnInstrument:
        """Shows the view, alone, with these options."""
        stage = d.stage
        stage.show(self.kind.name)
        if not stage.maximised:
            stage.maximise(self.kind.name)
        d.change(**{self.options: options})
        d.settle()
        return d.window.view(self.kind)

    def close(self, d: Driver) -> None:
        d.stage.maximise()
        d.stage.show(self.kind.name, False)
        d.settle()

    def item(self, name: str) -> str:
        return f"//{self.kind.name} maximised/{name}"
