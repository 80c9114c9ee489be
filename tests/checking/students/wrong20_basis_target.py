import numpy as np
def norm(a): return a / np.sqrt((a*a).sum())
def basis(eye, target, up):
    w = norm(-np.array(target, float))
    u = norm(np.cross(up, w))
    v = np.cross(w, u)
    return u, v, w
