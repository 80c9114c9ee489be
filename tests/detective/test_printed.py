"""A matrix is found in whatever somebody has copied; what holds none is one clear line."""

from __future__ import annotations

import contextlib
import json

import numpy as np
import pytest

from app.detective.model import beyond
from app.detective.options import MOST_CHARACTERS
from app.detective.printed import pasted
from renderer.errors import LucidaError

M = np.array(
    [[0.6, 0.0, 0.8, 3.5], [0.48, 0.8, -0.36, -2e-3], [-0.64, 0.6, 0.48, 12.0], [0, 0, 0, 1]]
)
K = np.array([[500.0, 0, 320], [0, 510, 240], [0, 0, 1]])
R, T = M[:3, :3], M[:3, 3]
ROWS = ["  ".join(f"{x:g}" for x in row) for row in M]


def brackets(matrix, left="[", right="]", comma=", "):
    rows = (left + comma.join(f"{x!r}" for x in row) + right for row in matrix.tolist())
    return left + comma.join(rows) + right


FORMS = {
    "bare lines": "\n".join(ROWS),
    "one line": " ".join(ROWS),
    "commas": ", ".join(", ".join(row.split()) for row in ROWS),
    "Python": str(M.tolist()),
    "Python tuples": brackets(M, "(", ")"),
    "NumPy's str": str(M),
    "NumPy's repr": repr(M),
    "NumPy, a script": f"import numpy as np\nM = np.array({M.tolist()}, dtype=np.float32)  # 4x4",
    "NumPy, reshaped": f"M = np.array({M.ravel().tolist()}).reshape(4, 4)",
    "NumPy 2's scalars": str([np.float64(x) for x in M.ravel()]),
    "PyTorch": f"tensor({brackets(M)}, device='cuda:0', dtype=torch.float64)",
    "MATLAB": "M = [" + "; ".join(ROWS) + "];",
    "MATLAB, shown": "\nM =\n\n    " + "\n    ".join(ROWS) + "\n\n",
    "MATLAB, with a factor": "M =\n\n   1.0e+01 *\n\n"
    + "\n".join("   ".join(f"{x / 10:g}" for x in row) for row in M),
    "Julia": "4\u00d74 Matrix{Float64}:\n  " + "\n  ".join(ROWS),
    "R": "      [,1] [,2] [,3] [,4]\n"
    + "\n".join(f"[{k},] {row}" for k, row in enumerate(ROWS, 1)),
    "C": "static const float m[16] = {" + ", ".join(f"{x!r}f" for x in M.ravel().tolist()) + "};",
    "C, two dimensions": f"double m[4][4] = {brackets(M, '{', '}')}; // camera 2 of 7",
    "C, one by one": "\n".join(
        f"m[{i}][{j}] = {M[i, j]!r};".replace("np.float64(", "").replace(")", "")
        for i in range(4)
        for j in range(4)
    ),
    "Unity's JSON": json.dumps({f"e{i}{j}": float(M[i, j]) for i in range(4) for j in range(4)}),
    "Direct3D, one by one": " ".join(
        f"_{i + 1}{j + 1}: {float(M[i, j])}" for i in range(4) for j in range(4)
    ),
    "GLSL": "mat4(" + ", ".join(map(str, M.ravel().tolist())) + ")",
    "JSON": json.dumps({"file_path": "r_12", "rotation": 0.3, "transform_matrix": M.tolist()}),
    "YAML": "pose:\n  rows: 4\n  cols: 4\n  dt: d\n  data: [" + ", ".join(map(str, M.flat)) + "]",
    "YAML's list": "\n" + "\n".join(f"- {x}" for x in M.ravel().tolist()),
    "XML": f'<transform name="to_world">\n<matrix value="{" ".join(ROWS)}"/>\n</transform>',
    "LaTeX": "\\begin{bmatrix}\n" + " \\\\\n".join(" & ".join(r.split()) for r in ROWS)
    + "\n\\end{bmatrix}",
    "Blender": "<Matrix 4x4 (" + ")\n            (".join(", ".join(r.split()) for r in ROWS) + ")>",
    "Windows' lines, tabs": "\r\n".join("\t".join(row.split()) for row in ROWS),
    "a typeset minus": "\n".join(ROWS).replace("-", "\u2212"),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_sixteen_numbers_in_every_print(form):
    found = pasted(FORMS[form])
    assert np.allclose(found.numbers, M.ravel(), rtol=1e-12)
    assert found.t is None and found.K is None and found.size is None


def test_twelve_numbers():
    assert np.array_equal(pasted("\n".join(ROWS[:3])).numbers, M[:3].ravel())
    assert np.array_equal(pasted(repr(M[:3])).numbers, M[:3].ravel())


@pytest.mark.parametrize(
    "text",
    [
        f"K = {K.tolist()}\nM = {M.tolist()}\nsize = 640x480",
        f"{M.tolist()}\n{K.tolist()}\nwidth: 640, height: 480",
        "\n".join(ROWS) + "\n\n" + "\n".join(" ".join(map(str, row)) for row in K) + "\n640 x 480",
        "\n".join(" ".join(map(str, row)) for row in K) + "\n" + "\n".join(ROWS) + "\nw=640, h=480",
        f"intrinsics = {K.T.tolist()} % MATLAB\npose = {M.tolist()}; ImageSize = [640 480]",
        json.dumps({"fl_x": 500, "fl_y": 510, "cx": 320, "cy": 240, "w": 640, "h": 480})
        + json.dumps({"transform_matrix": M.tolist()}),
        f"K = {(2 * K).tolist()}, image_size = (640, 480), M = {M.tolist()}",
    ],
)
def test_intrinsics_beside(text):
    found = pasted(text)
    assert np.array_equal(found.numbers, M.ravel())
    assert found.K is not None and np.array_equal(found.K, K)
    assert found.size == (640, 480)


@pytest.mark.parametrize(
    "beside",
    [
        "dist = [-0.25, 0.5, 0, 0.001, 0]",
        "k1: -0.25\nk2: 0.5\np1: 0\np2: 0.001\nk3: 0",
        "D: [-0.25, 0.5, 0.0, 0.001, 0.0]",
    ],
)
def test_a_lens_s_coefficients_are_no_matrix_and_no_shift(beside):
    found = pasted(f"K = {K.tolist()}\n{beside}\nR = {R.tolist()}\nt = {T.tolist()}")
    assert found.lens == (-0.25, 0.5, 0, 0.001, 0)
    assert found.t is not None and np.array_equal(found.t, T)
    assert "-0.25, 0.5, 0, 0.001, 0" in beyond(found)
    twelve = pasted(f"{M.tolist()}\ndistCoeffs = {list(range(12))}")
    assert np.array_equal(twelve.numbers, M.ravel()) and len(twelve.lens) == 12
    assert not beyond(pasted(f"D = [0, 0, 0, 0]\n{M.tolist()}"))


@pytest.mark.parametrize(
    "text",
    [
        f"R = {R.tolist()}\nt = {T.tolist()}",
        f"{R.tolist()}\n{T[:, None].tolist()}",
        f"t: {T.tolist()}\nR: {R.tolist()}\nK: {K.tolist()}",
        "\n".join(" ".join(map(str, row)) for row in R) + "\n\n" + " ".join(map(str, T)),
    ],
)
def test_a_rotation_and_a_translation(text):
    found = pasted(text)
    assert np.array_equal(found.numbers, R.ravel())
    assert found.t is not None and np.array_equal(found.t, T)
    assert (found.K is not None) == ("K" in text)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "is empty"),
        ("  \n", "is empty"),
        ("no matrix at all", "holds no numbers"),
        (" ".join(ROWS)[:-2], "holds 15 numbers"),
        (" ".join([*ROWS, "7"]), "holds 17 numbers"),
        ("42", "holds 1 number,"),
        ("\n".join(ROWS).replace("12", "nan"), "holds nan"),
        ("\n".join(ROWS).replace("12", "inf"), "holds inf"),
        ("\n".join(ROWS).replace("12", "1e999"), "too large"),
        ("\n".join(ROWS).replace("12", "24/2"), "'/2'"),
        ("\n".join(ROWS).replace("12", "- 12"), "'-'"),
        ("\n".join(ROWS).replace("12", "12i"), "'12i'"),
        ("\n".join(ROWS) + " * 2", "'*'"),
        ("[[1. 0. ... 0. 0.]\n ...\n [0. 0. 0. 1.]]", "leaves numbers out"),
        (f"{M.tolist()}\n{M.tolist()}", "holds 2 matrices"),
        (str(R.tolist()), "a rotation without a place"),
        (f"K = {K.tolist()}", "K, which says nothing of where"),
        (f"{M.tolist()} [[1, 2, 3], [4, 5, 6], [7, 8, 9]]", "neither K"),
        (f"{M.tolist()}\nsize = 640.5, 480", "640.5 x 480"),
        (f"{M.tolist()}\nsize = 640, 1000000", "1000000"),
        ("1 " * MOST_CHARACTERS, "too many"),
        ("[" * 5000, "holds no numbers"),
        ("\x00\x01\ufffd", "holds no numbers"),
    ],
)
def test_what_is_none_is_one_line(text, problem):
    with pytest.raises(LucidaError) as caught:
        pasted(text)
    told = str(caught.value)
    assert problem in told and "\n" not in told and caught.value.remedy


def test_any_text_is_a_matrix_or_one_line():
    """Pieces of the forms, put together anyhow."""
    chance = np.random.default_rng(5)
    pieces = [word for text in FORMS.values() for word in text.split(" ")]
    for _ in range(300):
        words = chance.choice(pieces, chance.integers(1, 30))
        with contextlib.suppress(LucidaError):
            found = pasted(" ".join(words))
            assert np.isfinite(found.numbers).all() and len(found.numbers) in (9, 12, 16)
