"""Students to be checked; and nothing that they started lives on."""

from __future__ import annotations

import textwrap

import pytest
from students import called

from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.tasks import Limits


@pytest.fixture
def student(tmp_path):
    """Makes a student of a file's text. limits: by name."""
    made = []

    def make(source: str | bytes, file: str = "rays.py", **limits) -> FileStudent:
        data = textwrap.dedent(source).encode() if isinstance(source, str) else source
        (tmp_path / file).write_bytes(data)
        made.append(FileStudent(tmp_path / file, Limits(**{"seconds": 60, **limits})))
        return made[-1]

    yield make
    for one in made:
        one.close()


@pytest.fixture
def answer(student):
    """Return the answer of a file's function f, called once with arguments by name."""

    def ask(source: str, /, **arguments):
        run = student(source).call([called("f", **arguments)])
        assert run.failure is None, run.failure
        return run.values[0]

    return ask
