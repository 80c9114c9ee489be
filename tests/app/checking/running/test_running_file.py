"""A student's file: what it may be, what it imports, and how its faults are told."""

from __future__ import annotations

import pytest
from students import CAMERA, called

from lucida.app.checking.running.file import FileStudent, NotRunnableError

F = called("f")
SYNTAX = {
    "no colon": (b"x = 1\ndef f()\n    return 1\n", "rays.py, line 2: SyntaxError: expected ':'"),
    "zeros": (b"\x7fELF\0\0\0", "source code"),
}


@pytest.mark.parametrize("name", SYNTAX)
def test_what_is_no_python_is_told_with_its_line(student, name):
    source, told = SYNTAX[name]
    one = student(source)
    with pytest.raises(NotRunnableError) as error:
        one.functions()
    run = one.call([F])
    assert (run.values, run.failure) == ((), error.value.failure)
    assert told in run.failure.text


def test_a_syntax_error_points_at_its_place(student):
    failure = student("x = 1\ndef f():\n    return 1 +* 2\n").call([F]).failure
    assert failure.traceback == (
        '  File "rays.py", line 3',
        "    return 1 +* 2",
        "              ^",
        "SyntaxError: invalid syntax",
    )


def test_what_is_no_file(tmp_path):
    (tmp_path / "folder.py").mkdir()
    (tmp_path / "long.py").write_bytes(b"#" * (5 << 20))
    for name, told in {
        "none.py": "does not exist",
        "folder.py": "is a folder",
        "long.py": "is too large",
    }.items():
        one = FileStudent(tmp_path / name)
        with pytest.raises(NotRunnableError, match=told):
            one.functions()
        assert one.call([F]).failure.kind == "missing"


@pytest.mark.parametrize("name", ["lucida", "camera"])
def test_imports_find_what_lies_beside_the_file(student, tmp_path, name):
    (tmp_path / f"{name}.py").write_text("mine = 7\n", "utf-8")
    assert student(f"import {name}\ndef f(): return {name}.mine\n").call([F]).values == (7,)
    assert not (tmp_path / "__pycache__").exists()


def test_it_runs_in_its_own_folder_from_any_other(student, tmp_path, monkeypatch):
    (tmp_path / "away").mkdir()
    monkeypatch.chdir(tmp_path / "away")
    (tmp_path / "table.txt").write_text("7", "utf-8")
    student("def f(): return int(open('table.txt').read())\n")
    with FileStudent("../rays.py") as one:
        assert one.call([F]).values == (7,)


def test_an_exception_is_told_with_the_students_own_lines(student, tmp_path):
    (tmp_path / "helper.py").write_text("def half(x):\n    return 1 / x\n", "utf-8")
    one = student("import helper\ndef f(i, j, camera):\n    return helper.half(i - j)\n")
    arguments = {"i": 3, "j": 3, "camera": {"eye": [0.0, 0.5, 1.0]}}
    run = one.call([called("f", **arguments), called("f", **{**arguments, "j": 2})])
    failure, right = run.values
    assert (right, failure.kind) == (1.0, "exception")
    assert failure.text == (
        "helper.py, line 2: ZeroDivisionError: division by zero; "
        "called as f(i=3, j=3, camera={eye: (0, 0.5, 1)})"
    )
    assert [line.strip(" ^~") for line in failure.traceback if line.strip(" ^~")] == [
        "Traceback (most recent call last):",
        'File "rays.py", line 3, in f',
        "return helper.half(i - j)",
        'File "helper.py", line 2, in half',
        "return 1 / x",
        "ZeroDivisionError: division by zero",
    ]


def test_an_exception_while_importing(student):
    one = student("print('begun')\nimport nothing_of_that_name\n")
    with pytest.raises(NotRunnableError) as error:
        one.functions()
    run = one.call([F])
    assert error.value.output == run.output == "begun\n"
    assert run.failure.text == (
        "rays.py, line 2: ModuleNotFoundError: No module named 'nothing_of_that_name'"
    )
    assert run.failure.traceback[1] == '  File "rays.py", line 2, in <module>'


def test_an_endless_recursion_is_short(student):
    (failure,) = student("def f(): return g()\ndef g(): return f()\n").call([F]).values
    assert "RecursionError: maximum recursion depth exceeded" in failure.text
    assert len(failure.traceback) < 50


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("class E(Exception):\n    def __str__(self): 1 / 0\ndef f(): raise E", "line 3: E;"),
        ("def f(): raise Exception('x' * 10**6)", "Exception: xxx"),
        ("def f(): return input('size? ')", "input() finds nothing here: use the arguments"),
        ("import sys\ndef f(): sys.exit('bye')", "it ends the program (SystemExit: bye); a func"),
        ("def f(): raise ValueError('\\x1b[31m\\0')", "ValueError: \\x1b[31m\\x00;"),
    ],
)
def test_unusual_exceptions_are_told_and_the_next_call_is_answered(student, source, told):
    one = student(source + "\ndef g(): return [[1.0]]\n")
    failure, right = one.call([F, called("g")]).values
    assert told in failure.text
    assert len(failure.text) < 500
    assert right == [[1.0]]


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("import sys; sys.exit()", "it ends the program (SystemExit); put what runs on its own"),
        ("n = int(input())", "input() finds nothing here: put what runs on its own under"),
    ],
)
def test_what_ends_a_file_while_it_is_imported(student, source, told):
    assert told in student(source).call([F]).failure.text


def test_the_arguments_of_a_call_are_told_in_a_line(student):
    given = {"image": [[[0.25] * 3] * 64] * 48, "text": "x" * 999, "camera": CAMERA}
    source = "def f(image, text, camera): return object()"
    (failure,) = student(source).call([called("f", **given)]).values
    told = failure.text.partition("called as ")[2]
    assert told.startswith("f(image=(((0.25, 0.25, 0.25), (0.25, ")
    assert ", text='xxx" in told
    assert len(told) < 400
