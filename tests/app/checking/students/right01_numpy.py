import numpy as np

def viewing_ray(i, j, width, height, camera):
    u, v, w, e = map(np.array, (camera.u, camera.v, camera.w, camera.eye))
    us = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    vs = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    if camera.projection == "parallel":
        return e + us * u + vs * v, -w
    d = us * u + vs * v - camera.distance * w
    return e, d / np.linalg.norm(d)
