"""All options of the window, as one immutable tree: shared ones, and those of each instrument.

Each field has its bounds (app/state/bounds.py). Session and lecture files name a field as in
`stepper.canvas`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, is_dataclass, replace
from typing import Any

from lucida.app.state.bounds import OptionPart

from .camera import CameraOptions
from .compare import CompareOptions
from .costs import CostOptions
from .laboratory import LaboratoryOptions
from .mistakes import MistakesOptions
from .objects import ObjectsOptions
from .outside import OutsideOptions
from .pair import PairOptions
from .photograph import PhotographOptions
from .poses import PosesOptions
from .probe import ProbeOptions
from .shared import SharedOptions
from .stepper import StepperOptions
from .your_code import YourCodeOptions


@dataclass(frozen=True)
class Options(SharedOptions):
    """The shared options and each instrument's."""

    camera: CameraOptions = field(default_factory=CameraOptions)
    photograph: PhotographOptions = field(default_factory=PhotographOptions)
    pair: PairOptions = field(default_factory=PairOptions)
    compare: CompareOptions = field(default_factory=CompareOptions)
    outside: OutsideOptions = field(default_factory=OutsideOptions)
    objects: ObjectsOptions = field(default_factory=ObjectsOptions)
    probe: ProbeOptions = field(default_factory=ProbeOptions)
    stepper: StepperOptions = field(default_factory=StepperOptions)
    costs: CostOptions = field(default_factory=CostOptions)
    laboratory: LaboratoryOptions = field(default_factory=LaboratoryOptions)
    mistakes: MistakesOptions = field(default_factory=MistakesOptions)
    your_code: YourCodeOptions = field(default_factory=YourCodeOptions)
    poses: PosesOptions = field(default_factory=PosesOptions)

    def with_changes(self, changes: Mapping[str, Any]) -> Options:
        """Return these options with fields changed by their names, as a lecture's file has them:
        {"shadows": True, "stepper": {"canvas": (8, 8)}}.
        """
        parts = {
            name: replace(getattr(self, name), **value) if isinstance(value, Mapping) else value
            for name, value in changes.items()
        }
        return replace(self, **parts)

    def with_parts(self, *parts: Options | OptionPart) -> Options:
        """Return these options with other parts, each in its place. `Options` replaces them all."""
        options = self
        for part in parts:
            if isinstance(part, Options):
                options = part
            else:
                options = options.with_changes({_NAMES[type(part)]: part})
        return options


_NAMES: dict[type, str] = {
    type(part): name for name, part in vars(Options()).items() if is_dataclass(part)
}
