import numpy as np
def viewing_ray(i, j, width, height, camera):
    u, v, w, e = map(np.array, (camera.u, camera.v, camera.w, camera.eye))
    l, r, b, t, d = camera.left, camera.right, camera.bottom, camera.top, camera.distance
    x = l + (r - l) * j / width
    y = b + (t - b) * i / height
    if camera.projection == "parallel":
        return e + x*u + y*v, -w
    return e, x*u + y*v - d*w
