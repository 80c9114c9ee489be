# inverse by transpose of the inverse: right for orthonormal cameras only. M rows u v w, world-from-camera = inv(M)
import numpy as np
def viewing_ray(i, j, width, height, camera):
    M = np.array([camera.u, camera.v, camera.w])
    R = np.linalg.inv(M)
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    e = np.array(camera.eye)
    if camera.projection == "parallel":
        return e + R @ [x, y, 0], R @ [0, 0, -1]
    return e, R @ [x, y, -camera.distance]
