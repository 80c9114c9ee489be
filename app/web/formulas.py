"""The formulas of a page as MathML in templates, in the book's notation like the probe's."""

from __future__ import annotations

from latex2mathml.converter import convert

from lucida.app.instruments.probe.lens_formulas import DIRECTIONS
from lucida.renderer.camera.pixels import Indexing

_ACROSS = r"u\,\mathbf{u} + v\,\mathbf{v}"
RAY = {
    "u": r"u = \mathrm{left} + (\mathrm{right} - \mathrm{left})\,\frac{j + 0.5}{W}",
    "v": r"v = \mathrm{top} - (\mathrm{top} - \mathrm{bottom})\,\frac{i + 0.5}{H}",
    "direction-perspective": rf"\mathbf{{d}} = {_ACROSS} - d\,\mathbf{{w}}",
    "direction-parallel": r"\mathbf{d} = -\mathbf{w}",
    "direction-lens": r"\mathbf{d} = d\,(X\,\mathbf{u} - Y\,\mathbf{v} - Z\,\mathbf{w})",
    "origin": r"\mathbf{p} = \mathbf{e}",
    "origin-parallel": rf"\mathbf{{p}} = \mathbf{{e}} + {_ACROSS}",
    "ray": r"\mathbf{r}(t) = \mathbf{p} + t\,\mathbf{d}",
    "point": r"\mathbf{x} = \mathbf{r}(t)",
    "normal": r"\mathbf{n}",
}

LENS = {
    "lens-plane": r"(a', b') = \left(\frac{u}{d},\ -\frac{v}{d}\right)",
    **{f"lens-{model}": f"(X, Y, Z) = {latex}" for model, latex in DIRECTIONS.items()},
}


def templates(indexing: Indexing = Indexing.ARRAY) -> str:
    """Return the HTML of a template for each formula of the probe, `formula-NAME`."""
    formulas = {
        name: latex.replace("+ 0.5", indexing.offset) for name, latex in (RAY | LENS).items()
    }
    return "".join(
        f'<template id="formula-{name}">{convert(latex)}</template>\n'
        for name, latex in formulas.items()
    )
