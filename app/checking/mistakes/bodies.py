"""The lines from (x, y) on the image plane to a ray, in perspective and in parallel projection, and
their mistakes.
"""

from __future__ import annotations

from app.checking.mistakes.program import CodeLine, Mistake, Swaps

Axes = tuple[int, int, int]

PART = "Any camera"
PARALLEL = "Parallel: the pixel moves the origin"
POINT = "That is the point on the image plane. The direction leads to it from the eye: subtract e."
AS_PARALLEL = (
    "That is the parallel ray. In perspective all rays start at the eye, and the direction "
    "depends on the pixel."
)
AS_PERSPECTIVE = (
    "That is the perspective ray. In parallel projection all directions are -w, and the origin "
    "depends on the pixel."
)
EXCHANGED = "Origin and direction are exchanged: the origin comes first."
NO_EYE = "That origin forgets the eye: origin = e + u u + v v."
TRANSPOSED = (
    "That multiplies by rows for columns. The basis vectors are the columns: u u + v v - d w."
)
INVERTED = "That leads from the world to the camera. From the camera to the world: u u + v v - d w."
RARE = {
    "divided by the distance",
    "from the eye to the viewport",
    "no w",
    "normalised",
    "the direction is the eye's",
}
# Replacements that apply them to a direction that another mistake has rewritten.
SWAPS: dict[str, Swaps] = {
    "no distance": ((" distance*w", " w"), ("-distance)", "-1)")),
    "along +w": (("*v - ", "*v + "),),
    "v the wrong way round": (("direction = x*u + y*v", "direction = x*u - y*v"),),
    "u the wrong way round": (("direction = x*u", "direction = -x*u"),),
    "a point, not a direction": (("direction = x*u", "direction = eye + x*u"),),
}


def body_lines(
    is_parallel: bool, matrix: str, distance: str, axes: Axes = (1, 1, 1)
) -> list[CodeLine]:
    """Return the lines that make origin and direction.

    matrix: the word of the matrix that replaces eye, u, v, w; or empty.
    axes: of its camera space, as in Conventions.
    """
    origin, direction = _right(is_parallel, matrix, distance, axes)
    return [
        CodeLine("origin", f"origin = {origin}"),
        CodeLine("direction", f"direction = {direction}"),
    ]


def _local(is_parallel: bool, distance: str, axes: Axes) -> tuple[str, str, str]:
    """Return numbers in camera space: those of the origin, of the direction, and of a direction
    with opposite z.
    """
    x, y = ("" if axis > 0 else "-" for axis in axes[:2])
    ahead, back = ("-", "") if axes[2] > 0 else ("", "-")
    point = f"{x}x, {y}y"
    if is_parallel:
        return f"{point}, 0", f"0, 0, {ahead}1", f"0, 0, {back}1"
    return "0, 0, 0", f"{point}, {ahead}{distance}", f"{point}, {back}{distance}"


def _right(
    is_parallel: bool, matrix: str, distance: str, axes: Axes = (1, 1, 1)
) -> tuple[str, str]:
    if matrix:
        to_world = matrix if matrix == "camera_to_world" else f"inverse({matrix})"
        at, to, _ = _local(is_parallel, distance, axes)
        return f"times_point({to_world}, vector({at}))", f"times_vector({to_world}, vector({to}))"
    if is_parallel:
        return "eye + x*u + y*v", "-w"
    return "eye", _along("x*u + y*v -", distance)


def _along(start: str, distance: str) -> str:
    return f"{start} w" if distance == "1" else f"{start} {distance}*w"


def _made(name: str, origin: str, direction: str, hint: str, part: str) -> Mistake:
    """Return the mistake of replacing these lines. origin, direction: the wrong code; empty for a
    correct line.
    """
    lines = (("origin", origin), ("direction", direction))
    written = tuple((key, f"{key} = {code}") for key, code in lines if code)
    return Mistake(name, written, hint, part, name not in RARE, SWAPS.get(name, ()))


def body_mistakes(
    is_parallel: bool, matrix: str, distance: str, axes: Axes = (1, 1, 1)
) -> list[Mistake]:
    if matrix:
        return _of_matrix(is_parallel, matrix, distance, axes)
    return _parallel(distance) if is_parallel else _perspective(distance)


def _perspective(distance: str) -> list[Mistake]:
    right = _right(False, "", distance)[1]
    local = f"vector(x, y, -{distance})"
    wrong = [
        ("u and v exchanged", "", _along("y*u + x*v -", distance),
         "u and v are exchanged: u, from the column j, comes first."),
        ("along +w", "", _along("x*u + y*v +", distance),
         "w points backwards: the direction has -d w."),
        ("a point, not a direction", "", f"eye + {right}", POINT),
        ("the camera's coordinates", "", local,
         "Those are the camera's coordinates u, v, -d: multiply the basis vectors by them."),
        ("as in parallel projection", "eye + x*u + y*v", "-w", AS_PARALLEL),
        ("v the wrong way round", "", _along("x*u - y*v -", distance),
         "v points up: the direction has + v v."),
        ("u the wrong way round", "", _along("-x*u + y*v -", distance),
         "u points to the right: the direction has + u u."),
        ("points backwards", "", f"-({right})",
         "That points backwards: t > 0 must lead into the scene."),
        ("the eye subtracted", "", f"{right} - eye",
         "u u + v v - d w is a direction already: the eye is not subtracted."),
        ("basis transposed", "", f"times(rows(u, v, w), {local})", TRANSPOSED),
        ("from the world to the camera", "", f"times(inverse(columns(u, v, w)), {local})",
         INVERTED),
        ("all rays along -w", "", "-w", AS_PARALLEL),
        ("no w", "", "x*u + y*v",
         "That lies in the plane of u and v: the direction has -d w."),
        ("the direction is the eye's", "", "eye",
         "The eye is where the ray begins, not where it leads."),
        ("the origin on the viewport", f"eye + {right}", "",
         "In perspective all rays start at the eye, not on the image plane."),
        ("the origin moves with the pixel", "eye + x*u + y*v", "",
         "In perspective all rays start at the eye, whatever the pixel."),
        ("no eye", "vector(0, 0, 0)", "",
         "The ray begins at the eye e, not at the world's origin."),
        ("origin and direction exchanged", right, "eye", EXCHANGED),
        ("normalised", "", f"normalized({right})",
         "The direction is right, its length is not: do not normalise it."),
    ]  # fmt: skip
    if distance != "1":
        no_distance = (
            "no distance", "", "x*u + y*v - w",
            "The image plane is at distance d, not at 1: the direction has -d w.",
        )  # fmt: skip
        wrong.insert(3, no_distance)
        wrong.append(
            ("divided by the distance", "", "x*u + y*v - w / distance",
             "The farther the image plane, the narrower the view: the direction has -d w.")
        )  # fmt: skip
    return [_made(*one, PART) for one in wrong]


def _parallel(distance: str) -> list[Mistake]:
    right = "eye + x*u + y*v"
    wrong = [
        ("u and v exchanged", "eye + y*u + x*v", "",
         "u and v are exchanged: u, from the column j, comes first."),
        ("along +w", "", "w", "w points backwards: the camera looks along -w."),
        ("no eye", "x*u + y*v", "", NO_EYE),
        ("the camera's coordinates", "vector(x, y, 0)", "vector(0, 0, -1)",
         "Those are the camera's coordinates: multiply the basis vectors by them."),
        ("the camera's coordinates, from the eye", "eye + vector(x, y, 0)", "vector(0, 0, -1)",
         "Those are the camera's coordinates: multiply the basis vectors by them."),
        ("as in perspective", "eye", _along("x*u + y*v -", distance), AS_PERSPECTIVE),
        ("v the wrong way round", "eye + x*u - y*v", "", "v points up: the origin has + v v."),
        ("u the wrong way round", "eye - x*u + y*v", "",
         "u points to the right: the origin has + u u."),
        ("all rays start at the eye", "eye", "",
         "All rays would be one. In parallel projection the pixel moves the origin."),
        ("the direction as in perspective", "", _along("x*u + y*v -", distance),
         AS_PERSPECTIVE),
        ("the origin on the plane at d", _along(f"{right} -", distance), "",
         "The rays begin in the plane of the eye: d has no part in parallel projection."),
        ("the eye subtracted", "x*u + y*v - eye", "", NO_EYE),
        ("basis transposed", "eye + times(rows(u, v, w), vector(x, y, 0))", "", TRANSPOSED),
        ("basis transposed, in both", "eye + times(rows(u, v, w), vector(x, y, 0))",
         "times(rows(u, v, w), vector(0, 0, -1))", TRANSPOSED),
        ("from the world to the camera",
         "eye + times(inverse(columns(u, v, w)), vector(x, y, 0))", "", INVERTED),
        ("from the world to the camera, in both",
         "eye + times(inverse(columns(u, v, w)), vector(x, y, 0))",
         "times(inverse(columns(u, v, w)), vector(0, 0, -1))", INVERTED),
        ("the camera's coordinates, in perspective", "vector(0, 0, 0)",
         f"vector(x, y, -{distance})",
         "That is the perspective ray in the camera's coordinates: here the pixel moves the "
         "origin, and the basis vectors are multiplied by these numbers."),
        ("origin and direction exchanged", "-w", right, EXCHANGED),
        ("along the world's -z", "", "vector(0, 0, -1)",
         "The camera looks along its own -w, not along the world's -z."),
        ("the direction is the eye's", "", "eye",
         "The eye is a point. All directions are -w."),
        ("from the eye to the viewport", "", "x*u + y*v",
         "The directions are all the same, -w. The pixel moves the origin alone."),
    ]  # fmt: skip
    return [_made(*one, PARALLEL) for one in wrong]


def _of_matrix(is_parallel: bool, matrix: str, distance: str, axes: Axes) -> list[Mistake]:
    part = PARALLEL if is_parallel else PART
    to_world = matrix if matrix == "camera_to_world" else f"inverse({matrix})"
    other = f"inverse({matrix})" if matrix == "camera_to_world" else matrix
    at, to, forwards = (f"vector({one})" for one in _local(is_parallel, distance, axes))
    point, along = f"times_point({to_world}, {at})", f"times_vector({to_world}, {to})"
    inverted = "That matrix leads from the world to the camera: the other one is needed."
    turned = "That multiplies by the matrix's rows for its columns: do not transpose it."
    wrong = [
        ("from the world to the camera", f"times_point({other}, {at})",
         f"times_vector({other}, {to})", inverted),
        ("the direction from the world to the camera", "", f"times_vector({other}, {to})",
         inverted),
        ("the origin from the world to the camera", f"times_point({other}, {at})", "", inverted),
        ("basis transposed", "", f"times_vector(transposed({to_world}), {to})", turned),
        ("matrix transposed", f"times_point(transposed({to_world}), {at})",
         f"times_vector(transposed({to_world}), {to})", turned),
        ("a point, not a direction", "", f"times_point({to_world}, {to})",
         "A direction's fourth number is 0: that moved it, as a point, by the eye."),
        ("the origin as a direction", f"times_vector({to_world}, {at})", "",
         "A point's fourth number is 1: that did not move it to the eye."),
        ("along +w", "", f"times_vector({to_world}, {forwards})",
         "w points backwards: the direction has -d w." if axes[2] > 0
         else "In this camera space z points forwards: the direction has + d, not -d."),
        ("points backwards", "", f"-{along}",
         "That points backwards: t > 0 must lead into the scene."),
        ("the camera's coordinates", at, to,
         "Those are the camera's coordinates: multiply the matrix by them."),
        ("the direction in the camera's coordinates", "", to,
         "Those are the camera's coordinates: multiply the matrix by them."),
        ("no eye", "vector(0, 0, 0)", "",
         "The ray begins at the eye e, not at the world's origin."),
    ]  # fmt: skip
    if axes[0] < 0:
        mirrored = _local(is_parallel, distance, (1, *axes[1:]))
        at_right, to_right = (f"vector({one})" for one in mirrored[:2])
        wrong.insert(
            0,
            ("the camera's x to the right",
             f"times_point({to_world}, {at_right})" if at_right != at else "",
             f"times_vector({to_world}, {to_right})" if to_right != to else "",
             "In this camera space x points to the left, not to the right: x is minus what it is "
             "along u."),
        )  # fmt: skip
    if not is_parallel:
        wrong.append(
            ("the origin on the viewport", f"times_point({to_world}, {to})", "",
             "In perspective all rays start at the eye, not on the image plane.")
        )  # fmt: skip
        wrong.append(
            ("normalised", "", f"normalized({along})",
             "The direction is right, its length is not: do not normalise it.")
        )  # fmt: skip
    else:
        wrong.append(("all rays start at the eye", point.replace(at, "vector(0, 0, 0)"), "",
                      "In parallel projection the pixel moves the origin."))  # fmt: skip
    return [_made(*one, part) for one in wrong]
