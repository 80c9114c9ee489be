"""The programs that are shown and copied, in Python, Julia and C.

expressions the common part of the three; which values are vectors
julia       Python's lines in Julia: the probe's program, the stepper's loops
c           the probe's program in C

Programs are written once, in Python, and translated, so that they cannot diverge. Only the Python
of this project's own programs is translated: numbers, vectors of three, loops.
"""

from __future__ import annotations

from app.state.options import Language

LANGUAGES: dict[Language, str] = {"python": "Python", "julia": "Julia", "c": "C"}
COMMENTS: dict[Language, str] = {"python": "#", "julia": "#", "c": "//"}
