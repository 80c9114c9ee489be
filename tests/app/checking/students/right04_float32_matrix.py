import numpy as np
def viewing_ray(i, j, width, height, camera):
    M = np.array([camera.u, camera.v, camera.w], dtype=np.float32).T
    x = np.float32(camera.left + (j + 0.5) / width * (camera.right - camera.left))
    y = np.float32(camera.top - (i + 0.5) / height * (camera.top - camera.bottom))
    e = np.asarray(camera.eye, np.float32)
    if camera.projection == "parallel":
        return {"origin": e + M @ np.array([x, y, 0], np.float32), "direction": M @ np.array([0, 0, -1], np.float32)}
    return {"origin": e, "direction": M @ np.array([x, y, -camera.distance], np.float32)}
