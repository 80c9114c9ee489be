"""Draws docs/camera.svg, the drawing in docs/camera.md, with the camera that it explains.

Run from the project's root: python docs/draw_camera.py
"""

from pathlib import Path

import numpy as np

from lucida import Camera

SIZE = (860, 430)
U, V, W, RAY, MARK = "#D55E00", "#009E73", "#0072B2", "#E69F00", "#F0E442"
INK, FAINT = "#333333", "#999999"

drawn = Camera(eye=(0, 0, 0), distance=2.0, viewport=(-0.8, 0.8, -0.6, 0.6))
outside = Camera.look_at((5.2, 2.2, 1.9), (0.0, 0.1, -1.78), fov_y_deg=27, aspect=2.0)
columns, rows = 8, 6
i, j = 1, 5  # the marked pixel
ball, radius = np.array((0.5, 0.58, -3.75)), 0.5


def at(point):
    row, column, _ = outside.project(point, SIZE)
    return float(column), float(row)


def line(p, q, color, width=1.5, extra=""):
    (x1, y1), (x2, y2) = at(p), at(q)
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
        f'stroke="{color}" stroke-width="{width}" {extra}/>'
    )


def polygon(points, fill, stroke="none", extra=""):
    corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, points))
    return f'<polygon points="{corners}" fill="{fill}" stroke="{stroke}" {extra}/>'


def text(point, words, color=INK, dx=0, dy=0, size=17, anchor="start"):
    x, y = at(point)
    return (
        f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{color}" font-size="{size}" '
        f'text-anchor="{anchor}">{words}</text>'
    )


def arrow(p, q, color, name):
    return line(p, q, color, 3, f'marker-end="url(#{name})"')


def on_plane(x, y):
    return np.array((x, y, -drawn.distance))


def drawing():
    left, right, bottom, top = drawn.viewport
    origin, direction = drawn.ray(i, j, (columns, rows))
    to_center = ball - origin
    middle = to_center @ direction / (direction @ direction)
    off = to_center - middle * direction
    t = middle - np.sqrt((radius**2 - off @ off) / (direction @ direction))
    hit = origin + t * direction
    corners = [
        on_plane(x, y) for x, y in ((left, bottom), (right, bottom), (right, top), (left, top))
    ]
    yield from (
        line(origin, corner * 2.1, FAINT, 1, 'stroke-dasharray="2 5"') for corner in corners
    )
    # The sphere's outline: an ellipse in principle, a circle to the eye at this angle.
    (cx, cy), (ex, ey) = at(ball), at(ball + radius * np.asarray(outside.v))
    yield (
        f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="{np.hypot(ex - cx, ey - cy):.1f}" '
        f'fill="url(#ball)" stroke="{FAINT}"/>'
    )
    yield line(direction, hit, RAY, 3.5)
    yield polygon(corners, "#ffffff", INK, 'fill-opacity="0.82" stroke-width="2"')
    x_edges, y_edges = np.linspace(left, right, columns + 1), np.linspace(bottom, top, rows + 1)
    yield from (line(on_plane(x, bottom), on_plane(x, top), FAINT, 0.8) for x in x_edges[1:-1])
    yield from (line(on_plane(left, y), on_plane(right, y), FAINT, 0.8) for y in y_edges[1:-1])
    x0, y1 = x_edges[j], y_edges[rows - i]
    x1, y0 = x_edges[j + 1], y_edges[rows - i - 1]
    yield polygon([on_plane(x, y) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))], MARK, INK)
    yield line((0, 0, 0), on_plane(0, 0), FAINT, 1.2, 'stroke-dasharray="6 4"')
    yield line(origin, direction, RAY, 3.5)
    yield from (
        arrow((0, 0, 0), axis, color, name)
        for axis, color, name in (
            ((0.62, 0, 0), U, "u"),
            ((0, 0.62, 0), V, "v"),
            ((0, 0, 0.75), W, "w"),
        )
    )
    for point, color in ((origin, INK), (direction, RAY), (hit, RAY)):
        x, y = at(point)
        yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{color}" stroke="#ffffff"/>'
    yield text((0.62, 0, 0), "<tspan font-weight='bold'>u</tspan> right", U, -8, 22, anchor="end")
    yield text((0, 0.62, 0), "<tspan font-weight='bold'>v</tspan> up", V, 0, -12, anchor="middle")
    yield text((0, 0, 0.75), "<tspan font-weight='bold'>w</tspan> back", W, -6, 26, anchor="middle")
    yield text((0, 0, 0), "eye", INK, -10, -8, anchor="end")
    yield text(on_plane(0, 0) * 0.45, "distance d", "#666666", 6, 24, 15, "middle")
    yield text(on_plane(right, bottom), "viewport: left, right, bottom, top", INK, 14, 12, 15)
    yield text(on_plane(x1, y1), "pixel (i, j)", INK, -6, -76, 15, "middle")
    (mx, my) = at(on_plane((x0 + x1) / 2, y1))
    leader = f"M{mx - 4:.1f} {my - 70:.1f}L{mx:.1f} {my - 3:.1f}"
    yield f'<path d="{leader}" stroke="{INK}" fill="none"/>'
    yield text(hit, "r(t) = origin + t direction", "#9a6a00", 40, -92, 16, "middle")


MARKERS = "".join(
    f'<marker id="{name}" viewBox="0 0 10 10" refX="6" refY="5" markerWidth="5" markerHeight="5" '
    f'orient="auto"><path d="M0 0L10 5L0 10z" fill="{color}"/></marker>'
    for name, color in (("u", U), ("v", V), ("w", W))
)
GRADIENT = (
    '<radialGradient id="ball" cx="0.35" cy="0.3" r="0.9"><stop offset="0" stop-color="#ffffff"/>'
    '<stop offset="1" stop-color="#9db7cc"/></radialGradient>'
)

if __name__ == "__main__":
    Path(__file__).with_name("camera.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE[0]} {SIZE[1]}" '
        'font-family="DejaVu Sans, Verdana, sans-serif">'
        f'<rect width="100%" height="100%" fill="#ffffff"/><defs>{MARKERS}{GRADIENT}</defs>\n'
        + "\n".join(drawing())
        + "\n</svg>\n"
    )
