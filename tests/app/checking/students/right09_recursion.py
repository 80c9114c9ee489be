"""Deutsch: rekursiv, Namen mit Umlauten."""


def zähle(anfang, schritt, n):
    return anfang if n == 0 else zähle(anfang + schritt, schritt, n - 1)


def viewing_ray(zeile, spalte, breite, höhe, kamera):
    pixelbreite = (kamera.right - kamera.left) / breite
    pixelhöhe = (kamera.top - kamera.bottom) / höhe
    x = zähle(kamera.left + pixelbreite / 2, pixelbreite, spalte)
    y = zähle(kamera.top - pixelhöhe / 2, -pixelhöhe, zeile)
    auge = kamera.eye
    if kamera.projection == "perspective":
        punkt = [auge[k] + x * kamera.u[k] + y * kamera.v[k] - kamera.distance * kamera.w[k] for k in range(3)]
        return {"origin": auge, "direction": [p - a for p, a in zip(punkt, auge)]}
    return {"origin": [auge[k] + x * kamera.u[k] + y * kamera.v[k] for k in range(3)],
            "direction": [-k for k in kamera.w]}
