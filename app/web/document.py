"""An HTML page in one file, with a policy that allows no other file or address.

The modules, the styles and the data are in the file. Its content security policy names the one
script and the one style by their hashes. All texts are escaped; data is JSON without `<`.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping
from html import escape
from importlib.resources import files
from typing import Any

from .bundle import bundle

_POLICY = (
    "default-src 'none'; script-src '{script}'; style-src '{style}'; img-src data: blob:; "
    "worker-src blob:; base-uri 'none'; form-action 'none'"
)
_START = '\nif (typeof document !== "undefined") start();\n'


def document(title: str, entry: str, body: str, data: Mapping[str, Any], style: str = "") -> str:
    """Return a page's HTML.

    entry: the module whose start() is called. body: HTML. data: values by the ids of the elements
    that hold them as JSON. style: CSS after the common style.
    """
    script = bundle(entry) + _START
    css = files("lucida.app.web").joinpath("page.css").read_text("utf-8") + style
    policy = _POLICY.format(script=_hash(script), style=_hash(css))
    values = "".join(
        f'<script type="application/json" id="{escape(name)}">{embedded(value)}</script>\n'
        for name, value in data.items()
    )
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{css}</style>\n</head>\n<body>\n"
        f'{body}{values}<script type="module" id="lucida-code">{script}</script>\n'
        "</body>\n</html>\n"
    )


def embedded(value: Any) -> str:
    """Return a value as JSON for a <script> element."""
    return json.dumps(value, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"sha256-{base64.b64encode(digest).decode()}"
