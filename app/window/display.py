"""A quick check whether there can be a display, as far as is known without asking for one.

Light to import.
"""

from __future__ import annotations

import os
import sys


def why_no_display() -> str:
    """Why there is none, in one line; empty where there may be one."""
    if not sys.platform.startswith("linux") or os.environ.get("DISPLAY"):
        return ""
    if os.environ.get("WAYLAND_DISPLAY"):
        return "this Wayland session has no XWayland (DISPLAY is not set)"
    return "DISPLAY is not set"
