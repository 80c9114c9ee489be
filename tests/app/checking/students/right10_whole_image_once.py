import numpy as np
_last = [None, None]


def all_rays(w, h, cam):
    jj, ii = np.meshgrid(np.arange(w), np.arange(h))
    x = cam.left + (jj + .5) / w * (cam.right - cam.left)
    y = cam.top + (ii + .5) / h * (cam.bottom - cam.top)
    p = x[..., None] * np.array(cam.u) + y[..., None] * np.array(cam.v)
    if cam.projection == "parallel":
        return np.array(cam.eye) + p, np.broadcast_to(-np.array(cam.w), p.shape)
    return np.broadcast_to(cam.eye, p.shape), p - cam.distance * np.array(cam.w)


def viewing_ray(i, j, width, height, camera):
    if _last[0] is not camera:
        _last[:] = camera, all_rays(width, height, camera)
    o, d = _last[1]
    return o[i, j], d[i, j]
