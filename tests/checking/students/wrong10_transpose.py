import numpy as np
def viewing_ray(i, j, width, height, camera):
    B = np.array([camera.u, camera.v, camera.w])
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    if camera.projection == "perspective":
        return camera.eye, B @ [x, y, -camera.distance]
    return camera.eye + B @ [x, y, 0], B @ [0, 0, -1]
