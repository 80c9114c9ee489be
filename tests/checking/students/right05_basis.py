import numpy as np
from numpy.linalg import norm
def basis(eye, target, up):
    gaze = np.subtract(target, eye)
    w = -gaze / norm(gaze)
    u = np.cross(up, w); u /= norm(u)
    return u, np.cross(w, u), w
