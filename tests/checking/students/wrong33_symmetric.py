# from ndc times right and top: right for a symmetric viewport only
import numpy as np
def viewing_ray(i, j, width, height, camera):
    e, u, v, w = (np.asarray(a) for a in (camera.eye, camera.u, camera.v, camera.w))
    px = (2 * (j + 0.5) / width - 1) * camera.right
    py = (1 - 2 * (i + 0.5) / height) * camera.top
    if camera.projection == "parallel":
        return e + px * u + py * v, -w
    return e, px * u + py * v - camera.distance * w
