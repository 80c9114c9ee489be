"""The drives of the window by their names, TOPIC/DRIVE: functions of the scenarios."""

import runpy
from collections.abc import Callable
from pathlib import Path


def topic_of(name: str) -> str:
    """Return the topic of TOPIC/DRIVE, or of TOPIC alone."""
    topic, _, last = name.rpartition("/")
    return topic if last.startswith("drive_") else name


def drives(names: list[str]) -> dict[str, Callable[..., None]]:
    """Return drives by their names, TOPIC/DRIVE."""
    scenarios = Path(__file__).parents[1] / "app" / "window" / "scenarios"
    found = {}
    for topic in dict.fromkeys(map(topic_of, names)):
        functions = runpy.run_path(str(scenarios / f"{topic}.py")).items()
        found |= {f"{topic}/{name}": one for name, one in functions if name.startswith("drive_")}
    return {one: drive for one, drive in found.items() if {one, topic_of(one)} & {*names}}
