"""The kinds of functions that a task can ask for, one per file.

kind         the base class, and reading what a student's function returned, generously
viewing_ray  the ray of a pixel
basis        a camera's basis from a target
hits         a sphere, a triangle, the nearest of several; their mathematics: shapes
images       gray, one bit per pixel, the place in memory
render       both loops
"""

from __future__ import annotations

from lucida.app.checking.kinds.basis import BASIS
from lucida.app.checking.kinds.hits import CLOSEST, SPHERE, TRIANGLE
from lucida.app.checking.kinds.images import BITMAP, GRAY, OFFSET
from lucida.app.checking.kinds.kind import CheckKind
from lucida.app.checking.kinds.render import RENDER
from lucida.app.checking.kinds.viewing_ray import VIEWING_RAY

# In the order of the lecture, as the built-in tasks.
IN_ORDER: tuple[CheckKind, ...] = (
    GRAY, BITMAP, OFFSET, VIEWING_RAY, BASIS, SPHERE, TRIANGLE, CLOSEST, RENDER,
)  # fmt: skip
KINDS = {kind.name: kind for kind in IN_ORDER}
