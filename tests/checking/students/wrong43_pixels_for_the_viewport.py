import numpy as np

def viewing_ray(i, j, width, height, camera):
    e, u, v, w = (np.array(camera[k]) for k in ("eye", "u", "v", "w"))
    x = j + 0.5 - width / 2
    y = height / 2 - i - 0.5
    if camera.projection == "parallel":
        return e + x * u + y * v, -w
    return e, x * u + y * v - camera.distance * w
