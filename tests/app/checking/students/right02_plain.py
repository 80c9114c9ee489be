# no numpy
def add(a, b): return (a[0]+b[0], a[1]+b[1], a[2]+b[2])
def mul(s, a): return (s*a[0], s*a[1], s*a[2])

def viewing_ray(i, j, width, height, camera):
  s = camera.left + (j+.5)*(camera.right-camera.left)/width
  t = camera.bottom + (height-1-i+.5)*(camera.top-camera.bottom)/height
  p = add(mul(s, camera.u), mul(t, camera.v))
  if camera.projection == 'perspective':
     return camera.eye, add(p, mul(-camera.distance, camera.w))
  else:
     return add(camera.eye, p), mul(-1, camera.w)
