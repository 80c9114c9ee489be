"""The programs that are shown and copied, in Python, Julia and C.

expressions what the three write alike; which values are vectors
julia       Python's lines in Julia: the probe's program, the stepper's loops
c           the probe's program in C

Programs are written in Python once, and the others made from them: they cannot part. What is
translated is the Python of this project's own programs: numbers, vectors of three, loops; not any.
"""

from __future__ import annotations

from app.state.options import Language

LANGUAGES: dict[Language, str] = {"python": "Python", "julia": "Julia", "c": "C"}
COMMENTS: dict[Language, str] = {"python": "#", "julia": "#", "c": "//"}
