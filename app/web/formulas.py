"""The formulas of a page, as MathML in templates: the book's notation, as the probe has it."""

from __future__ import annotations

from latex2mathml.converter import convert

from lucida.app.instruments.probe.lens_formulas import ANGLES, PANORAMAS
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

_WAY = r"(X, Y, Z) = \left(\sin\theta\,A,\ \sin\theta\,B,\ \cos\theta\right),\ \theta = "
_IDEAL = _WAY.replace("A", r"\frac{a'}{r'}").replace("B", r"\frac{b'}{r'}")
_FISHEYE = _WAY.replace("A", r"\frac{U}{\theta}").replace("B", r"\frac{V}{\theta}")
LENS = {
    "lens-plane": r"(a', b') = \left(\frac{u}{d},\ -\frac{v}{d}\right)",
    "lens-brown": "(X, Y, Z) = (a, b, 1)",
    "lens-fisheye": _FISHEYE + r"\sqrt{U^2 + V^2}",
    "lens-thin_prism_fisheye": _FISHEYE + r"\sqrt{U^2 + V^2}",
    **{f"lens-{model}": _IDEAL + angle for model, (angle, _) in ANGLES.items()},
    **{f"lens-{model}": f"(X, Y, Z) = {way}" for model, (way, _) in PANORAMAS.items()},
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
