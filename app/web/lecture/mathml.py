"""Formulas as MathML, in the colours of vectors. Only known elements and attributes are written."""

from __future__ import annotations

import functools
import re
from html import escape, unescape
from xml.etree.ElementTree import Element

from latex2mathml.converter import convert_to_element

from lucida.app.ui.explaining.breaking import breakable

ELEMENTS = frozenset(
    (
        *("math", "mrow", "mi", "mn", "mo", "ms", "mtext", "mspace", "mfrac", "msqrt", "mroot"),
        *("msub", "msup", "msubsup", "munder", "mover", "munderover", "mmultiscripts", "none"),
        *("mprescripts", "mtable", "mtr", "mtd", "mpadded", "mphantom", "mstyle"),
    )
)
ATTRIBUTES = frozenset(
    (
        *("stretchy", "fence", "form", "separator", "lspace", "rspace", "symmetric", "accent"),
        *("accentunder", "movablelimits", "largeop", "linethickness", "displaystyle"),
        *("scriptlevel", "columnalign", "minsize", "maxsize"),
    )
)
_VALUE = re.compile(r"[\w.%+ -]{0,40}")
_WIDTH = re.compile(r"-?[\d.]+(?:em|ex)")
_SPACE = '<mspace width="0.167em"></mspace>'  # around sin and cos
_BOLD = 0x1D400  # first of Unicode's bold letters, A to Z and then a to z
_SANS = 0x1D5A0
VECTORS = frozenset((*"uvwpdrx", "origin", "direction", "point"))  # names that have colours


@functools.lru_cache(2048)
def inline(latex: str) -> str:
    """Return a formula in a line, as HTML."""
    return _math(latex, display=False)


def displayed(latex: str) -> str:
    """Return a displayed formula as HTML, which may break before its signs."""
    parts = (_math(part, display=True) for part in breakable(latex))
    return f'<p class="formula">{" ".join(parts)}</p>\n'


def _math(latex: str, display: bool) -> str:
    try:
        root = convert_to_element(latex)
    except Exception:  # the library's errors have no common base, and a formula may be anything
        return f"<code>{escape(latex)}</code>"
    style = ' displaystyle="true"' if display else ""
    if display and latex[:1] in "=+-" and (sign := root.find("mrow/mo")) is not None:
        sign.set("form", "infix")  # it continues the row before it
    return f"<math{style}>{_content(root)}</math>"


def _content(element: Element) -> str:
    children = _merged(list(element))
    if element.tag != "mrow":  # slots of a fraction or an index
        return "".join(map(_written, children))
    spaced = []
    for number, child in enumerate(children):
        name = child.text or ""
        is_function = child.tag == "mi" and len(name) > 1 and name.isalpha() and not child.attrib
        around = _SPACE if is_function else ""
        spaced.append((around if number else "") + _written(child) + around)
    return "".join(spaced)


def _merged(children: list[Element]) -> list[Element]:
    """Return the elements, with the letters of a word merged into one."""
    kept: list[Element] = []
    for child in children:
        variant = child.get("mathvariant")
        before = kept[-1] if kept else None
        if (
            before is not None
            and variant is not None
            and child.tag == before.tag == "mi"
            and variant == before.get("mathvariant")
        ):
            before.text = f"{before.text}{child.text}"
        else:
            kept.append(child)
    return kept


def _written(element: Element) -> str:
    tag = element.tag if element.tag in ELEMENTS else "mrow"
    if tag == "math":
        return _content(element)
    attributes = {
        name: value
        for name, value in element.attrib.items()
        if name in ATTRIBUTES and _VALUE.fullmatch(value)
    }
    if tag == "mspace" and _WIDTH.fullmatch(width := element.get("width", "")):
        attributes["width"] = width
    text = unescape(element.text or "")
    if tag == "mi":
        text, attributes = _identifier(text, element.get("mathvariant", ""))
    if text == ":":
        tag = "mo"
    given = "".join(f' {name}="{escape(value)}"' for name, value in attributes.items())
    shown = escape(text if tag == "mtext" else text.strip())
    return f"<{tag}{given}>{shown}{_content(element)}</{tag}>"


def _identifier(text: str, variant: str) -> tuple[str, dict[str, str]]:
    """Return a name in letters that all fonts have, and its attributes."""
    plain = "".join(map(_plain, text))
    if plain != text and ord(text[0]) >= _SANS:
        return plain, {"mathvariant": "normal", "class": "sans"}
    if plain != text or variant == "bold":
        color = f" vector-{plain}" if plain in VECTORS else ""
        return plain, {"mathvariant": "normal", "class": f"bold{color}"}
    if variant == "italic":
        return plain, {"class": "italic"}
    return plain, {"mathvariant": "normal"} if variant == "normal" else {}


def _plain(letter: str) -> str:
    for first in (_BOLD, _SANS):
        place = ord(letter) - first
        if 0 <= place < 52:
            return chr(place + (65 if place < 26 else 71))
    return letter
