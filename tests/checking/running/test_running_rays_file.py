"""Files of rays: what they may look like, and how their faults are told."""

from __future__ import annotations

import numpy as np
import pytest
from students import called

from app.checking.running.rays_file import RaysFile
from renderer.errors import LucidaError

ROWS = [(i, j, 0.5, 0, 5, j - 1.5, 1 - i, -1) for i in range(2) for j in range(3)]
CALLS = [called("viewing_ray", i=i, j=j, width=3, height=2) for i in range(2) for j in range(3)]
RIGHT = tuple({"origin": [0.5, 0, 5], "direction": [j - 1.5, 1 - i, -1]} for i, j, *_ in ROWS)
NAMES = ["i", "j", "ox", "oy", "oz", "dx", "dy", "dz"]


def text(separator: str = ",", names=NAMES, end: str = "\n", point: str = ".") -> str:
    order = [NAMES.index(name.lower()) for name in names]
    lines = [separator.join(names)]
    for row in ROWS:
        lines.append(separator.join(str(row[k]).replace(".", point) for k in order))
    return end.join(lines) + end


WITHOUT_NAMES = text().partition("\n")[2]
FILES = {
    "as it is": text().encode(),
    "other order": text(names=["DZ", "dx", "DY", "J", "i", "OX", "oz", "oy"]).encode(),
    "semicolons": text("; ").encode(),
    "decimal commas": text(";", point=",").encode(),
    "tabs": text("\t").encode(),
    "spaces": text("  ").encode(),
    "no names": WITHOUT_NAMES.encode(),
    "names as they like": text()
    .replace("i,j,ox,oy,oz,dx,dy,dz", '"row", col ,origin_x,O.y,oZ,Direction X,dir_y,[dz]')
    .encode(),
    "mark of UTF-8": b"\xef\xbb\xbf" + text().encode(),
    "comments": ("# rays\n\n// of\n% mine\n" + text().replace("\n", "\n\n#\n")).encode(),
    "more columns": "\n".join(line + ",9,x" for line in text().split()).encode(),
    "twice the same": (WITHOUT_NAMES + WITHOUT_NAMES).encode(),
}


@pytest.mark.parametrize("name", FILES)
def test_a_table_as_programs_write_it(tmp_path, name):
    (tmp_path / "rays.csv").write_bytes(FILES[name])
    rays = RaysFile(tmp_path / "rays.csv")
    assert rays.functions() is None
    run = rays.call(CALLS)
    assert run.failure is None
    assert run.values == RIGHT


FAULTS = {
    "empty": ("", "rays.csv: is empty"),
    "only names": ("i,j,ox,oy,oz,dx,dy,dz\n", "rays.csv: it has 0 rays"),
    "missing column": ("i,j,ox,oy,oz,dx,dy\n", "rays.csv: line 1: there is no column dz"),
    "column twice": ("i,j,ox,oy,oz,dx,dy,dz,I\n", "line 1: two columns are named i"),
    "too few in a line": (WITHOUT_NAMES + "1,2\n", "rays.csv: invalid column index 2 at row 7"),
    "no number": (text() + "5,5,1,2,3,x,1,1\n", "could not convert string 'x' to float64 at row 6"),
    "half a pixel": ("0.5,0,1,1,1,1,1,1\n", "ray 1: i is 0.5, no whole number"),
    "another ray": (
        text() + "# again\n0,0,1,1,1,1,1,1\n",
        "ray 7: is another one of pixel i = 0, j = 0; give one ray a pixel",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_wrong_in_a_table_is_told_with_its_line(tmp_path, name):
    source, told = FAULTS[name]
    (tmp_path / "rays.csv").write_bytes(source.encode())
    rays = RaysFile(tmp_path / "rays.csv")
    with pytest.raises(LucidaError) as error:
        rays.functions()
    assert told in str(error.value)
    assert str(error.value).count("rays.csv") == 1
    run = rays.call(CALLS)
    assert (run.values, run.failure.kind, run.failure.text) == ((), "missing", str(error.value))


def array(dtype=np.float64):
    return np.array(ROWS, dtype)


ARRAYS = {
    "(N, 8)": array(),
    "float32": array(np.float32),
    "(H, W, 6)": array()[:, 2:].reshape(2, 3, 6),
}


@pytest.mark.parametrize("name", ARRAYS)
def test_an_array_as_numpy_saves_it(tmp_path, name):
    np.save(tmp_path / "rays.npy", ARRAYS[name])
    assert RaysFile(tmp_path / "rays.npy").call(CALLS).values == RIGHT


def test_an_image_of_rays_counts_from_the_tasks_base(tmp_path):
    np.save(tmp_path / "rays.npy", ARRAYS["(H, W, 6)"])
    calls = [called("f", i=i + 1, j=j + 1) for i in range(2) for j in range(3)]
    assert RaysFile(tmp_path / "rays.npy", base=1).call(calls).values == RIGHT


WRONG_ARRAYS = {
    "shape": (np.zeros((4, 5)), "has the shape (4, 5); wanted are (N, 8)"),
    "objects": (np.array([None], object), "Object arrays cannot be loaded"),
    "texts": (np.array([["x"] * 8]), "holds <U1, not numbers"),
    "another ray": (
        np.vstack([array(), [[0, 0, 9, 9, 9, 9, 9, 9]]]),
        "ray 7: is another one of pixel i = 0, j = 0",
    ),
    "half": (array() + 0.5, "ray 1: i is 0.5, no whole number"),
    "empty": (np.zeros((0, 8)), "it has 0 rays"),
}


@pytest.mark.parametrize("name", WRONG_ARRAYS)
def test_what_is_wrong_in_an_array_is_told(tmp_path, name):
    value, told = WRONG_ARRAYS[name]
    np.save(tmp_path / "rays.npy", value)
    text = RaysFile(tmp_path / "rays.npy").call(CALLS).failure.text
    assert told in text
    assert text.startswith("rays.npy: ")


@pytest.mark.parametrize(
    "data",
    [
        b"i,j\n",
        b"PK\3\4 a zip",
        b"\x93NUMPY\1\0\x10\0{'descr': 7",
        b"\x93NUMPY\1\0\x80\0"
        + b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999, 8)}".ljust(128),
    ],
)
def test_what_numpy_has_not_written(tmp_path, data):
    (tmp_path / "rays.npy").write_bytes(data)
    text = RaysFile(tmp_path / "rays.npy").call(CALLS).failure.text
    assert text.startswith("rays.npy: is no array of numbers that NumPy wrote: ")
    assert text.endswith("; write it with numpy.save")


def test_a_pixel_that_is_not_there(tmp_path):
    (tmp_path / "rays.csv").write_text(text(), "utf-8")
    run = RaysFile(tmp_path / "rays.csv").call([*CALLS, called("viewing_ray", i=2, j=0)])
    assert run.values[:-1] == RIGHT
    failure = run.values[-1]
    assert (failure.kind, failure.call) == ("missing", 6)
    assert failure.text == ("rays.csv: there is no ray of pixel i = 2, j = 0")


def test_what_is_asked_without_a_pixel(tmp_path):
    (tmp_path / "rays.csv").write_text(text(), "utf-8")
    (failure,) = RaysFile(tmp_path / "rays.csv").call([called("basis", eye=[0, 0, 0])]).values
    assert "answers nothing but rays by i and j, not basis" in failure.text
