"""The kinds of functions that a task can ask for, one per file.

kind         the base class, and reading what a student's function returned, generously
viewing_ray  the ray of a pixel
basis        a camera's basis from a target
hits         a sphere, a triangle, the nearest of several; their mathematics: shapes
render       both loops: an image
"""

from __future__ import annotations

from .basis import BASIS
from .hits import CLOSEST, SPHERE, TRIANGLE
from .kind import CheckKind
from .render import RENDER
from .viewing_ray import VIEWING_RAY

# In the order of the lecture, as the built-in tasks.
IN_ORDER: tuple[CheckKind, ...] = (VIEWING_RAY, BASIS, SPHERE, TRIANGLE, CLOSEST, RENDER)
KINDS = {kind.name: kind for kind in IN_ORDER}
