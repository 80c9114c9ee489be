import numpy as np
def basis(eye, target, up):
    f = np.subtract(target, eye); f = f / np.linalg.norm(f)
    r = np.cross(f, up); r = r / np.linalg.norm(r)
    return r, np.cross(r, f), f
