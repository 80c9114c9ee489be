class Vec3:
    def __init__(self, x, y, z):
        self.x = x; self.y = y; self.z = z
    def __add__(self, o): return Vec3(self.x + o.x, self.y + o.y, self.z + o.z)
    def __sub__(self, o): return Vec3(self.x - o.x, self.y - o.y, self.z - o.z)
    def __rmul__(self, s): return Vec3(s * self.x, s * self.y, s * self.z)
    def __iter__(self): return iter((self.x, self.y, self.z))

class Ray:
    def __init__(self, origin, direction):
        self.origin = origin
        self.direction = direction

def viewing_ray(i, j, width, height, camera):
    e = Vec3(*camera.eye); u = Vec3(*camera.u); v = Vec3(*camera.v); w = Vec3(*camera.w)
    a = camera.left + (camera.right - camera.left) * ((j + 0.5) / width)
    b = camera.top + (camera.bottom - camera.top) * ((i + 0.5) / height)
    point = a * u + b * v
    if camera.projection == "parallel":
        return Ray(e + point, -1 * w)
    screen = e + point - camera.distance * w
    return Ray(e, screen - e)
