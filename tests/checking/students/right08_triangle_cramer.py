import numpy as np
def hit_triangle(origin, direction, a, b, c):
    A = np.column_stack([np.subtract(a, b), np.subtract(a, c), direction])
    try:
        beta, gamma, t = np.linalg.solve(A, np.subtract(a, origin))
    except np.linalg.LinAlgError:
        return None
    return t if beta >= 0 and gamma >= 0 and beta + gamma <= 1 and t > 0 else None
