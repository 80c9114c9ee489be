"""Files of rays: what they may look like, and how their faults are told."""

from __future__ import annotations

import numpy as np
import pytest
from students import called

from app.checking.running.rays_file import RaysFile
from renderer.errors import LucidaError

ROWS = [(i, j, 0.5, 0, 5, j - 1.5, 1 - i, -1) for i in range(2) for j in range(3)]
CALLS = [called("viewing_ray", i=i, j=j, width=3, height=2) for i in range(2) for j in range(3)]
RIGHT = tuple([0.5, 0, 5, j - 1.5, 1 - i, -1] for i, j, *_ in ROWS)
NAMES = ["i", "j", "ox", "oy", "oz", "dx", "dy", "dz"]


def text(separator: str = ",", names=NAMES) -> str:
    order = [NAMES.index(name.lower()) for name in names]
    rows = (separator.join(str(row[k]) for k in order) for row in ROWS)
    return "\n".join([separator.join(names), *rows, ""])


FILES = {
    "other order": "\ufeff" + text(names=["DZ", "dx", "DY", "J", "i", "OX", "oz", "oy"]),
    "semicolons": text("; "),
    "no names": text("\t").partition("\n")[2],
}


@pytest.mark.parametrize("name", FILES)
def test_a_table_as_programs_write_it(tmp_path, name):
    (tmp_path / "rays.csv").write_text(FILES[name], "utf-8")
    rays = RaysFile(tmp_path / "rays.csv")
    assert rays.functions() is None
    assert rays.call(CALLS).values == RIGHT


FAULTS = {
    "only names": ("i,j,ox,oy,oz,dx,dy,dz\n", "it has 0 rays"),
    "missing column": ("i,j,ox,oy,oz,dx,dy\n", "'dz' is not in list"),
    "too few in a line": (text() + "1,2\n", "invalid column index 2 at row 7"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_wrong_in_a_table_is_told(tmp_path, name):
    source, told = FAULTS[name]
    (tmp_path / "rays.csv").write_text(source, "utf-8")
    rays = RaysFile(tmp_path / "rays.csv")
    with pytest.raises(LucidaError) as error:
        rays.functions()
    assert str(error.value).startswith(f"rays.csv: is no table of rays: {told}")
    run = rays.call(CALLS)
    assert (run.values, run.failure.kind, run.failure.text) == ((), "missing", str(error.value))


@pytest.mark.parametrize("base", [0, 1])
def test_an_array_as_numpy_saves_it(tmp_path, base):
    table = np.array(ROWS, np.float32)
    calls = [called("f", i=i + base, j=j + base) for i in range(2) for j in range(3)]
    for array in (table + np.eye(2, 8).sum(axis=0) * base, table[:, 2:].reshape(2, 3, 6)):
        np.save(tmp_path / "rays.npy", array)
        assert RaysFile(tmp_path / "rays.npy", base).call(calls).values == RIGHT


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (np.zeros((4, 5)), "not (4, 5)"),
        (np.array([None], object), "Object arrays cannot be loaded"),
        (np.array([["x"] * 8]), "could not convert string"),
    ],
)
def test_what_is_wrong_in_an_array_is_told(tmp_path, value, told):
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
    assert text.startswith("rays.npy: is no table of rays: ")


def test_a_pixel_that_is_not_there(tmp_path):
    (tmp_path / "rays.csv").write_text(text(), "utf-8")
    run = RaysFile(tmp_path / "rays.csv").call([*CALLS, called("viewing_ray", i=2, j=0)])
    assert run.values[:-1] == RIGHT
    failure = run.values[-1]
    assert (failure.kind, failure.call) == ("missing", 6)
    assert failure.text == ("rays.csv: there is no ray of pixel i = 2, j = 0")
