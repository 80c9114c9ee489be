"""Every package that Lucida installs, its extras included, has a licence that allows it."""

from __future__ import annotations

import re
from importlib import metadata

from packaging.requirements import Requirement

ALLOWED = re.compile(
    r"\b(MIT|0?BSD|Apache|ISC|PSF|MPL|LGPL|Zlib|CC0)\b|\bRedistribution and use in source and"
    r"|\bPermission is hereby granted, free of charge"  # MIT's text without its name
)
FORBIDDEN = re.compile(r"\bA?GPL|\bGeneral Public License")


def required(name: str, found: dict[str, metadata.Distribution], extras: tuple[str, ...] = ()):
    """Add a distribution and all that it requires here to `found`, by name."""
    if name.lower() in found:
        return
    found[name.lower()] = metadata.distribution(name)
    for text in found[name.lower()].requires or ():
        entry = Requirement(text)
        marker = entry.marker
        if marker is None or any(marker.evaluate({"extra": extra}) for extra in ("", *extras)):
            required(entry.name, found, tuple(entry.extras))


def licence(distribution: metadata.Distribution) -> str:
    """Return what a distribution says of its licence: metadata, else the text of its file."""
    about = distribution.metadata
    said = [about.get("License-Expression") or "", (about.get("License") or "")[:200]]
    said += [line for line in about.get_all("Classifier") or () if line.startswith("License")]
    if not ALLOWED.search(" ".join(said)):
        files = [file for file in distribution.files or () if "LICENSE" in file.name.upper()]
        said += [file.read_text() for file in files]
    return " ".join(said)


def test_every_dependency_has_an_allowed_licence():
    found: dict[str, metadata.Distribution] = {}
    required("camera-lucida", found, ("film", "notebook"))
    assert {"numba", "llvmlite", "av", "dask", "anywidget", "traitlets"} <= found.keys()
    for name, distribution in found.items():
        said = licence(distribution)
        assert ALLOWED.search(said), (name, said[:300])
        rest = re.sub(r"\bLGPL|Lesser General Public License", "", said)
        assert not FORBIDDEN.search(rest), (name, rest[:300])
