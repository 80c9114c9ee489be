import numpy as np
def basis(eye, target, up):
    w = np.array(eye) - np.array(target)
    w = w / np.linalg.norm(w)
    u = np.cross(w, up)
    u = u / np.linalg.norm(u)
    v = np.cross(w, u)
    return u, v, w
