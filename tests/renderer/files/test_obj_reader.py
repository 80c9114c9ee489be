"""The .obj reader against a plain one, line by line; its numbers are exact."""

from __future__ import annotations

import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida.renderer.files.models import polygons, texts
from lucida.renderer.files.models.obj import read_obj
from lucida.renderer.files.models.parts import Part
from lucida.renderer.files.texture_images import ModelImages

Triangles = list[tuple[Any, ...]]

FORMS = {
    "v": lambda v, vt, vn: f"{v}",
    "v/vt": lambda v, vt, vn: f"{v}/{vt}",
    "v/vt/": lambda v, vt, vn: f"{v}/{vt}/",
    "v//vn": lambda v, vt, vn: f"{v}//{vn}",
    "v/vt/vn": lambda v, vt, vn: f"{v}/{vt}/{vn}",
}
NUMBERS: list[Callable[[random.Random], str]] = [
    lambda dice: f"{dice.uniform(-2, 2):.{dice.choice([0, 1, 3, 6, 9, 17])}f}",
    lambda dice: repr(dice.gauss(0, 100)),
    lambda dice: f"{dice.gauss(0, 1e-3):.{dice.choice([3, 8])}e}",
    lambda dice: dice.choice(["-0", "-0.0", "+1.5", ".5", "-.25", "3.", "0005.500", "1E+2"]),
    lambda dice: dice.choice(["9007199254740993", "900719925474099.3", "0." + "1234567890" * 3]),
]


def random_text(dice: random.Random, forms: list[str], negative: bool) -> str:
    """An .obj text: some objects and materials, polygons of all kinds; the last line is a face."""
    width, blank = dice.choice([3, 3, 4, 6]), dice.choice([" ", " ", "  ", "\t", " \t "])
    kinds = dice.sample(NUMBERS, 2)
    counts = {"v": 0, "vt": 0, "vn": 0}
    lines = ["# mtllib none.mtl"]
    for _ in range(dice.choice([1, 2, 4])):
        rows = []
        for kind, least, columns in (("v", 3, width), ("vt", 1, 2), ("vn", 1, 3)):
            for _ in range(dice.randrange(least, 7)):
                numbers = [dice.choice(kinds)(dice) for _ in range(columns)]
                rows.append(blank.join([kind, *numbers]))
                counts[kind] += 1
        if dice.random() < 0.5:
            dice.shuffle(rows)
        lines += rows
        for _ in range(dice.randrange(1, 7)):
            if dice.random() < 0.4:
                lines.append(dice.choice(["o x", "o x_1", "o y z", "usemtl a", "g b", "s 1", ""]))
            form, corners = dice.choice(forms), []
            for _ in range(dice.choice([3, 3, 4, 6])):
                indices = [
                    -dice.randint(1, n) if negative and dice.random() < 0.5 else dice.randint(1, n)
                    for n in counts.values()
                ]
                corners.append(FORMS[form](*indices))
            lines.append(blank.join(["f", *corners]) + dice.choice(["", " ", " # f 1 2 3"]))
    if dice.random() < 0.2:
        lines = [dice.choice(["", " ", "\t"]) + line for line in lines]
    return dice.choice(["\n", "\r\n", "\r"]).join(lines)


def plainly_read(text: str) -> dict[tuple[str | None, str | None], Triangles]:
    """For each object and material its triangles: three corners, each with position, further
    numbers of its vertex, and normal."""
    rows: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
    faces: list[tuple[tuple[str | None, str | None], list[list[int]]]] = []
    found: str | None = None
    used: str | None = None
    for line in text.splitlines():
        keyword, *words = line.partition("#")[0].split() or [""]
        if keyword in rows:
            rows[keyword].append([float(word) for word in words])
        elif keyword == "o":
            found = " ".join(words)
        elif keyword == "usemtl":
            used = " ".join(words)
        elif keyword == "f":
            polygon = []
            for word in words:
                indices = []
                for kind, index in zip(rows, [*word.split("/"), "", ""], strict=False):
                    number = int(index or 0)
                    indices.append(number - 1 if number >= 0 else len(rows[kind]) + number)
                polygon.append(indices)
            fans = [[polygon[0], polygon[k], polygon[k + 1]] for k in range(1, len(polygon) - 1)]
            faces += [((found, used), fan) for fan in fans]
    parts: dict[tuple[str | None, str | None], Triangles] = {}
    for key in dict.fromkeys(key for key, _ in faces):
        mine = [triangle for other, triangle in faces if other == key]
        bare = all(corner[2] < 0 for triangle in mine for corner in triangle)
        normals = [[]] if bare else [*rows["vn"], [0.0, 0.0, 0.0]]  # the last one for a flat face
        parts[key] = [
            tuple((*rows["v"][v][:3], *normals[-1 if bare else vn]) for v, _, vn in triangle)
            for triangle in mine
        ]
    return parts


def of_part(part: Part) -> Triangles:
    numbers = np.asarray(part.vertices)[:, :3]
    if part.normals is not None:
        numbers = np.hstack([numbers, part.normals])
    rows = [tuple(row) for row in numbers.tolist()]
    return [tuple(rows[corner] for corner in face) for face in np.asarray(part.faces).tolist()]


@pytest.mark.parametrize("negative", [False, True])
@pytest.mark.parametrize("forms", [[form] for form in FORMS] + [list(FORMS)], ids="/".join)
def test_random_files_are_read_as_a_plain_reader_does(
    forms: list[str], negative: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(polygons, "TURNED", np.inf)  # all polygons are fans
    dice = random.Random(f"{forms} {negative}")
    for _ in range(25):
        text = random_text(dice, forms, negative)
        (tmp_path / "x.obj").write_text(text, newline="")
        parts = read_obj(tmp_path / "x.obj", ModelImages())
        assert repr([of_part(part) for part in parts]) == repr([*plainly_read(text).values()])


@given(
    st.lists(
        st.one_of(
            st.floats(allow_nan=False).map(repr),
            st.decimals(allow_nan=False, allow_infinity=False, places=6).map("{:f}".format),
            st.from_regex(
                r"[-+]?([0-9]{1,25}\.?[0-9]{0,25}|\.[0-9]{1,25})(e[-+]?[0-9]{1,3})?", fullmatch=True
            ),
        ),
        max_size=8,
    )
)
def test_numbers_are_what_float_makes_of_them(numbers: list[str]) -> None:
    for some in (numbers, [n for n in numbers if "e" not in n and "inf" not in n]):
        text = " {} \n".format("\t".join(some)).encode()
        begins, counts = texts.words(text)
        assert counts.tolist() == [len(some)]
        expected = np.array([float(number) for number in some])
        assert texts.floats(text, begins).tobytes() == expected.tobytes()


@pytest.mark.parametrize("wrong", ["1-2", "1.2.3", ".", "-", "+-1", "1e", "x", "1,5", "0x1", "1_0"])
def test_what_is_no_number_is_refused(wrong: str) -> None:
    for others in ("", " .", " 7", " 1.5 .25", " 1e5"):
        text = f" {wrong}{others}\n".encode()
        with pytest.raises(ValueError, match=r"number|unmatched"):
            texts.floats(text, texts.words(text)[0])


def test_an_obj_needs_no_trimesh(tmp_path: Path) -> None:
    (tmp_path / "x.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    code = (
        "import sys; from lucida.renderer.files import load_scene; load_scene(sys.argv[1]);"
        "sys.exit(any(name in sys.modules for name in ('trimesh', 'PIL', 'scipy')))"
    )
    assert subprocess.run([sys.executable, "-c", code, str(tmp_path / "x.obj")]).returncode == 0
