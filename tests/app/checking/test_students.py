"""Programs as students write them, right ones and edited ones, and the diagnosis of each."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from lucida.app.checking.checked import TaskResult, check
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.task_file import BUILTIN

Edits = Sequence[tuple[str, str]]

STUDENTS = {path.stem: path for path in (Path(__file__).parent / "students").glob("*.py")}
TASKS = {task.name: task for task in BUILTIN}
RAYS = "viewing-ray", "viewing-ray-parallel"
COUNTS = 11  # of right programs
HALF = [("j + 0.5", "j"), ("i + 0.5", "i")]
ROWS = [("camera.top - (camera", "camera.bottom + (camera")]
VECTORS = "map(np.array, (camera.u, camera.v, camera.w, camera.eye))"
ANGLE = "np.arctan(camera.top / camera.distance)"
X = "camera.left + (camera.right - camera.left) * (j + 0.5) / width"
Y = "camera.top - (camera.top - camera.bottom) * (i + 0.5) / height"


def from_the_angle(half: str) -> Edits:
    """Make the viewport symmetric, from the tangent of the angle upwards."""
    aspect = "(camera.right - camera.left) / (camera.top - camera.bottom)"
    x = f"(2 * (j + 0.5) / width - 1) * {half} * {aspect}"
    return [(X, x), (Y, f"(1 - 2 * (i + 0.5) / height) * {half}")]


# Edits of right01_numpy; a phrase that the diagnosis has in perspective, and in parallel projection
# (empty where the answer is right); and if it is known by a mistake's name (None: in one of both).
WRONG_RAYS: dict[str, tuple[Edits, str, str, bool | None]] = {
    "book_rows": (ROWS, "v needs its minus sign", "v needs its minus sign", True),
    "no_half": (HALF, *("Its centre is half a pixel further",) * 2, True),
    "from_one": ([("+ 0.5", "- 0.5")], *("from 0: add the half pixel",) * 2, True),
    "w_minus_one": (
        [("(j + 0.5) / width", "j / (width - 1)"), ("(i + 0.5) / height", "i / (height - 1)")],
        *("divide by W, not by W - 1",) * 2,
        True,
    ),
    "plus_w": (
        [("- camera.distance", "+ camera.distance"), ("-w", "w")],
        *("w points backwards",) * 2,
        True,
    ),
    "forgot_d": ([("camera.distance * w", "w")], "is at camera.d, not at 1", "", True),
    "point": ([("d = us", "d = e + us")], "subtract camera.e", "", True),
    "ij": (
        [("(j +", "(row +"), ("(i +", "(j +"), ("(row +", "(i +")],
        *("the column j gives u, the row i gives v",) * 2,
        True,
    ),
    "wh": (
        [("/ width", "/ side"), ("/ height", "/ width"), ("/ side", "/ height")],
        *("The column is divided by W",) * 2,
        True,
    ),
    "transpose": (
        [(VECTORS, "(*np.array([camera.u, camera.v, camera.w]).T, np.array(camera.eye))")],
        *("rows for columns",) * 2,
        True,
    ),
    "parallel_eye": ([("e + us * u + vs * v,", "e,")], "", "the pixel moves the origin", True),
    "origin_on_plane": (
        [("e, d / np.linalg.norm(d)", "e + d, d")],
        "all rays start at the eye, not on the image plane",
        "",
        True,
    ),
    "two_at_once": ([*HALF, *ROWS], "Two mistakes at once.", "v needs its minus sign", True),
    "book_centered": (
        [(X, "(j + 0.5) / width - 0.5"), (Y, "-((i + 0.5) / height - 0.5)")],
        *("-0.5 to 0.5",) * 2,
        True,
    ),
    "int_division": (
        [("(j + 0.5) / width", "((j + 0.5) // width)"),
         ("(i + 0.5) / height", "((i + 0.5) // height)")],
        *("// gives whole numbers",) * 2,
        True,
    ),
    "v_flipped": (
        [("+ vs * v", "- vs * v")],
        "v points up: the direction has + v*camera.v",
        "v points up: the origin has + v*camera.v",
        True,
    ),
    "camera_space": (
        [("    if camera", "    return (0, 0, 0), (us, vs, -camera.distance)\n    if camera")],
        "Those are the camera's coordinates",
        "in the camera's coordinates",
        True,
    ),
    "as_perspective": ([('== "parallel"', '== "none"')], "", "That is the perspective ray", True),
    "swapped_return": (
        [("e + us * u + vs * v, -w", "-w, e + us * u + vs * v"),
         ("e, d / np.linalg.norm(d)", "d, e")],
        *("the origin comes first",) * 2,
        True,
    ),
    "square_pixels": (
        [("(camera.top - camera.bottom) * (i + 0.5) / height",
          "(camera.right - camera.left) * (i + 0.5) / width")],
        *("Pixels need not be square: a row is (camera.top - camera.bottom) / H high.",) * 2,
        True,
    ),
    "symmetric": (
        [(X, "(2 * (j + 0.5) / width - 1) * camera.right"),
         (Y, "(1 - 2 * (i + 0.5) / height) * camera.top")],
        *("The viewport need not have 0 in its middle",) * 2,
        True,
    ),
    "pixels_for_the_viewport": (
        [(X, "j + 0.5 - width / 2"), (Y, "height / 2 - i - 0.5")],
        *("Those are pixels from the image's middle",) * 2,
        True,
    ),
    "radians": (
        from_the_angle(f"np.tan(np.radians({ANGLE})) * camera.distance"),
        "Your origins are correct, your directions are not.",
        "Your directions are correct, your origins are not.",
        False,
    ),
    "orthonormal": (
        [(VECTORS, "(*np.linalg.inv([camera.u, camera.v, camera.w]).T, np.array(camera.eye))")],
        *("correct where the basis is orthonormal, and wrong elsewhere",) * 2,
        False,
    ),
}  # fmt: skip

# Edits of one function of right05_values: the task, the edit, and the phrase.
WRONG_VALUES = [
    ("basis", "np.cross(up, w)", "np.cross(w, up)", "u = cross(up, w), in this order"),
    ("basis", "np.subtract(target, eye)", "np.array(target, float)", "The target is a point"),
    ("basis", "np.cross(w, u), w", "np.array(up) / norm(up), w", "up only says which way is up"),
    ("basis", "np.cross(w, u), w", "np.cross(w, u), -w", "w points back"),
    ("basis", "np.cross(up, w)", "np.cross((0, 1, 0), w)", "it is not always the world's y."),
    ("hit-sphere", "(-half_b - s)/a, ", "*(), ", "the smaller t > 0 is the nearer hit"),
    ("hit-sphere", "if t > 0", "if True", "What has t < 0 lies behind"),
    ("hit-sphere", "if t > 0:\n            return t", "return abs(t)",
     "its absolute value is no hit"),
    ("hit-sphere", "disc = half_b*half_b - a*c", "disc = abs(half_b*half_b - a*c)",
     "With a discriminant below 0 there is no root"),
    ("hit-triangle", "return t if beta >= 0 and gamma >= 0 and beta + gamma <= 1 and t > 0",
     "return abs(t) if beta >= 0 and gamma >= 0 and beta + gamma <= 1",
     "its absolute value is no hit"),
    ("hit-sphere", "a = dx*dx + dy*dy + dz*dz", "a = 1", "a = dot(d, d), not 1"),
    ("hit-sphere", "- a*c", "- a*c/4", "The discriminant is b^2 - 4 a c"),
    ("hit-triangle", "t if beta >= 0", "t if t > 0 or beta >= 0", "inside the triangle"),
]  # fmt: skip

LAST_WINS = (
    "int(np.argmin(ts)) if ts else -1",
    "max((k for k, t in enumerate(ts) if t < inf), default=-1)",
)
HALVES = [("(j + 0.5)", "j"), ("(i + 0.5)", "i")]
IMAGE = "return image"
# Edits of a whole program: the program, and for each task a phrase, or None if it is right.
WRONG_PROGRAMS: dict[str, tuple[str, Edits, dict[str, str | None]]] = {
    "the last object, and no half pixel": (
        "right11_vectors_of_its_own",
        [LAST_WINS, *HALVES],
        {
            "hit-sphere": None,
            "hit-triangle": None,
            **dict.fromkeys(RAYS, "Its centre is half a pixel further"),
            "closest-hit": "compare with the smallest t so far",
            "render": "Two mistakes at once. The nearest hit wins",
        },
    ),
    "upside down and blue for red": (
        "right11_vectors_of_its_own",
        [(IMAGE, "return [[p[::-1] for p in map(list, row)] for row in image[::-1]]")],
        {"render": "Two mistakes at once."},
    ),
    "three at once have no name": (
        "right11_vectors_of_its_own",
        [LAST_WINS, (IMAGE, "return [[[255 * c for c in p] for p in row[::-1]] for row in image]")],
        {"render": ""},
    ),
    "a word that objects lack": (
        "right11_vectors_of_its_own",
        [("o.type", "o.kind")],
        {"closest-hit": "failed: there is no 'kind' in it; it has: type, center, radius"},
    ),
}


def edited(source: str, edits: Edits) -> str:
    for old, new in edits:
        assert old in source, old
        source = source.replace(old, new)
    return source


def named(function: str, number: object) -> str:
    return f"{function}_{number}"


@pytest.fixture(scope="module")
def wrong(tmp_path_factory: pytest.TempPathFactory) -> Iterator[FileStudent]:
    """Return one student with all wrong functions, each under a name of its own."""
    values = STUDENTS["right05_values"].read_text("utf-8")
    sources = [values]
    for number, (task, old, new, _) in enumerate(WRONG_VALUES):
        function = TASKS[task].function
        (source,) = re.findall(
            rf"^def {function}\(.*?(?=^def |\Z)", values, re.MULTILINE | re.DOTALL
        )
        sources.append(
            edited(source, [(old, new), (f"def {function}", f"def {named(function, number)}")])
        )
    ray = STUDENTS["right01_numpy"].read_text("utf-8")
    for name, (edits, *_) in WRONG_RAYS.items():
        sources.append(edited(ray, [*edits, ("viewing_ray", named("viewing_ray", name))]))
    path = tmp_path_factory.mktemp("wrong") / "wrong.py"
    path.write_text("\n\n".join(sources), "utf-8")
    with FileStudent(path) as student:
        yield student


def assert_found(result: TaskResult, says: str, known: bool | None) -> None:
    assert result.status == "wrong" and result.diagnosis is not None, result.lines
    assert says in " ".join(result.diagnosis.sentences).replace("`", ""), result.lines
    assert known is None or bool(result.diagnosis.candidates) == known


@pytest.mark.parametrize("name", STUDENTS)
def test_right_programs_are_right(name: str) -> None:
    with FileStudent(STUDENTS[name]) as student:
        tasks = [task for task in BUILTIN if task.function in student.functions()]
        results = list(check(student, tasks))
    assert results and len(STUDENTS) == COUNTS
    for result in results:
        assert result.status == "right", (result.task.name, result.lines)


@pytest.mark.parametrize("name", WRONG_RAYS)
def test_wrong_rays_are_found_and_their_mistake_named(wrong: FileStudent, name: str) -> None:
    """In both projections, or, where both have the same phrase, in one or the other."""
    _, *says, known = WRONG_RAYS[name]
    asked = [replace(TASKS[task], function=named("viewing_ray", name), count=5) for task in RAYS]
    if says[0] == says[1]:
        one = list(WRONG_RAYS).index(name) % 2
        asked, says = asked[one : one + 1], says[one : one + 1]
    for result, phrase in zip(check(wrong, asked), says, strict=True):
        if phrase:
            assert_found(result, phrase, known)
        else:
            assert result.status == "right"


@pytest.mark.parametrize("number", range(len(WRONG_VALUES)))
def test_wrong_values_are_found_and_their_mistake_named(wrong: FileStudent, number: int) -> None:
    task, _, _, says = WRONG_VALUES[number]
    (result,) = check(wrong, [replace(TASKS[task], function=named(TASKS[task].function, number))])
    assert_found(result, says, True)


@pytest.mark.parametrize("name", WRONG_PROGRAMS)
def test_wrong_programs_are_judged_task_by_task(tmp_path: Path, name: str) -> None:
    right, edits, expected = WRONG_PROGRAMS[name]
    path = tmp_path / "student.py"
    path.write_text(edited(STUDENTS[right].read_text("utf-8"), edits), "utf-8")
    with FileStudent(path) as student:
        results = list(check(student, [TASKS[task] for task in expected]))
    for result, says in zip(results, expected.values(), strict=True):
        if says is None:
            assert result.status == "right", result.lines
        elif says.startswith("failed: "):
            assert result.status == "failed"
            assert says.removeprefix("failed: ") in result.lines[0]
        else:
            assert_found(result, says, bool(says))
