import numpy as np
def basis(eye, target, up):
    w = np.subtract(eye, target); w = w / np.linalg.norm(w)
    v = np.array(up) / np.linalg.norm(up)
    u = np.cross(v, w)
    return u / np.linalg.norm(u), v, w
