"""A student's file: what it may be, what it imports, and how its faults are told."""

from __future__ import annotations

import json
import os
import sys

import pytest
from students import CAMERA, called

from app.checking.running.file import FileStudent, NotRunnableError

F = called("f")
SYNTAX = {
    "no colon": (b"x = 1\ndef f()\n    return 1\n", "rays.py, line 2: SyntaxError: expected ':'"),
    "tabs": (b"def f():\n\tif 1:\n        return 1\n", "rays.py, line 3: TabError: inconsistent"),
    "windows": (b"def f():\r\n    return (1\r\n", "rays.py, line 2: SyntaxError: '(' was never"),
    "bytes": (bytes(range(128, 256)) * 9, "SyntaxError: (unicode error) 'utf-8' codec"),
    "zeros": (b"\x7fELF\0\0\0", "source code"),
    "cookie": (b"# coding: klingon\n", "klingon"),
    "nested": (b"x = " + b"(" * 500 + b")" * 500, "too many nested parentheses"),
    "deep": (b"x = " + b"-" * 100_000 + b"1\n", "needs more than the memory limit of 1024 MB"),
    "notebook": (b'{"cells": [\n], "metadata": null}', "NameError: name 'null'"),
}
AS_IT_IS = {
    "CRLF": b"def f():\r\n\treturn 'a\\\r\nb'\r\n",
    "BOM": b"\xef\xbb\xbfdef f(): return 'ab'",
    "Latin-1": b"# -*- coding: latin-1 -*-\ndef f(): return '\xe4b'.replace('\xe4', 'a')\n",
    "old Mac": b"def f():\r return 'ab'\r",
}


@pytest.mark.parametrize("name", AS_IT_IS)
def test_files_as_editors_write_them(student, name):
    assert student(AS_IT_IS[name]).call([F]).values == ("ab",)


@pytest.mark.parametrize("name", SYNTAX)
def test_what_is_no_python_is_told_with_its_line(student, name):
    source, told = SYNTAX[name]
    one = student(source)
    with pytest.raises(NotRunnableError) as error:
        one.functions()
    run = one.call([F])
    assert run.values == ()
    assert run.failure == error.value.failure
    assert run.failure.kind in ("syntax", "exception", "memory")
    assert told in run.failure.text
    assert "\n" not in run.failure.text
    assert not any("<lucida>" in line for line in run.failure.traceback)


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
        "none.py": "none.py: there is no such file",
        "folder.py": "folder.py: it is a folder",
        "long.py": "long.py: it is longer than 4 MB",
        "a\0b.py": "cannot be read: embedded null byte",
    }.items():
        one = FileStudent(tmp_path / name)
        with pytest.raises(NotRunnableError, match=told):
            one.functions()
        assert one.call([F]).failure.kind == "missing"


@pytest.mark.skipif(sys.platform == "win32", reason="POSIX has such files")
def test_what_is_no_regular_file_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.py")
    assert "it is no file" in FileStudent(tmp_path / "pipe.py").call([F]).failure.text
    assert "it is no file" in FileStudent("/dev/zero").call([F]).failure.text


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root reads all")
def test_an_unreadable_file(student, tmp_path):
    one = student("")
    (tmp_path / "rays.py").chmod(0)
    assert "cannot be read: Permission denied" in one.call([F]).failure.text


def test_an_empty_file_has_no_function(student):
    one = student("")
    assert one.functions() == frozenset()
    (failure,) = one.call([F]).values
    assert (failure.kind, failure.text) == ("missing", "rays.py has no function f; it has none")


def test_a_missing_function_is_told_with_those_that_are_there(student):
    one = student(
        """
        from math import *
        import json
        def veiwing_ray(): return 1
        def main(): pass
        viewing_rays = 3
        """
    )
    first, second = one.call([called("viewing_ray"), called("main")]).values
    assert first.text == (
        "rays.py has no function viewing_ray; it has: veiwing_ray, main; did you mean veiwing_ray?"
    )
    assert second is None
    assert {"veiwing_ray", "main", "sqrt"} <= one.functions()


def test_what_stands_under_main_is_not_run(student):
    one = student("def f(): return __name__\nif __name__ == '__main__':\n    raise SystemExit(3)\n")
    assert one.call([F]).values == ("rays",)


@pytest.mark.parametrize("name", ["app", "renderer", "camera", "numpy", "traceback", "queue"])
def test_imports_find_what_lies_beside_the_file(student, tmp_path, name):
    (tmp_path / f"{name}.py").write_text("mine = 7\n", "utf-8")
    assert student(f"import {name}\ndef f(): return {name}.mine\n").call([F]).values == (7,)
    assert not (tmp_path / "__pycache__").exists()


def test_a_folder_beside_the_file_is_found_before_ours(student, tmp_path):
    (tmp_path / "renderer").mkdir()
    (tmp_path / "renderer" / "camera.py").write_text("mine = 7\n", "utf-8")
    one = student("from renderer.camera import mine\ndef f(): return mine\n")
    assert one.call([F]).values == (7,)


@pytest.mark.parametrize("name", ["json.py", "queue.py", "2 rays-of light.py", "app.py", "os.py"])
def test_a_file_of_any_name(student, name):
    one = student("import json, queue\ndef f(): return json.loads('[1]')\n", name)
    assert one.call([F]).values == ([1],)


def test_nothing_of_ours_is_among_its_modules(student):
    one = student(
        """
        import sys
        def f():
            ours = [name for name in sys.modules if "student_" in name or "app" == name]
            main = sys.modules["__main__"]
            return ours, [name for name in vars(main) if not name.startswith("__")], sys.argv[1:]
        """
    )
    assert one.call([F]).values == ([[], [], []],)


def test_it_runs_in_its_own_folder_and_from_a_link(student, tmp_path, monkeypatch):
    (tmp_path / "away").mkdir()
    monkeypatch.chdir(tmp_path / "away")
    (tmp_path / "table.txt").write_text("7", "utf-8")
    student("def f(): return int(open('table.txt').read())\n")
    with FileStudent("../rays.py") as one:
        assert one.call([F]).values == (7,)


def test_an_exception_is_told_with_the_students_own_lines(student, tmp_path):
    (tmp_path / "helper.py").write_text("def half(x):\n    return 1 / x\n", "utf-8")
    one = student(
        """
        import helper
        def f(i, j, camera):
            return helper.half(i - j)
        """
    )
    arguments = {"i": 3, "j": 3, "camera": {"eye": [0.0, 0.5, 1.0]}}
    run = one.call([called("f", **arguments), called("f", **{**arguments, "j": 2})])
    failure, right = run.values
    assert right == 1.0
    assert failure.kind == "exception"
    assert failure.text == (
        "helper.py, line 2: ZeroDivisionError: division by zero; "
        "called as f(i=3, j=3, camera={eye: (0, 0.5, 1)})"
    )
    assert failure.traceback == (
        "Traceback (most recent call last):",
        '  File "rays.py", line 4, in f',
        "    return helper.half(i - j)",
        "           ^^^^^^^^^^^^^^^^^^",
        '  File "helper.py", line 2, in half',
        "    return 1 / x",
        "           ~~^~~",
        "ZeroDivisionError: division by zero",
    )


def test_an_exception_while_importing(student):
    run = student("print('begun')\nimport nothing_of_that_name\n").call([F])
    assert run.values == ()
    assert run.output == "begun\n"
    assert run.failure.text == (
        "rays.py, line 2: ModuleNotFoundError: No module named 'nothing_of_that_name'"
    )
    assert run.failure.traceback[1] == '  File "rays.py", line 2, in <module>'
    assert "frozen" not in "".join(run.failure.traceback)


def test_what_a_file_prints_before_it_fails_is_kept_with_the_error(student):
    one = student("print('begun')\n1 / 0\n")
    with pytest.raises(NotRunnableError) as error:
        one.functions()
    assert error.value.output == one.call([F]).output == "begun\n"


def test_a_chain_of_exceptions_has_no_line_of_ours(student):
    (failure,) = (
        student(
            """
        def f():
            try:
                return {}["a"]
            except KeyError as error:
                raise ValueError("no\\nsuch") from error
        """
        )
        .call([F])
        .values
    )
    text = "\n".join(failure.traceback)
    assert "KeyError" in text
    assert "direct cause" in text
    assert "<lucida>" not in text
    assert "ValueError: no such; called as f()" in failure.text


def test_an_endless_recursion_is_short(student):
    (failure,) = student("def f(): return g()\ndef g(): return f()\n").call([F]).values
    assert "RecursionError: maximum recursion depth exceeded" in failure.text
    assert len(failure.traceback) < 50
    assert any("lines left out" in line for line in failure.traceback)


def test_many_exceptions(student):
    run = student("def f(i):\n    return f(i)\n").call([called("f", i=i) for i in range(60)])
    assert all(failure.kind == "exception" for failure in run.values)
    assert [bool(failure.traceback) for failure in run.values] == [True] * 3 + [False] * 57
    assert all(f"f(i={i})" in failure.text for i, failure in enumerate(run.values))


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("class E(Exception):\n    def __str__(self): 1 / 0\ndef f(): raise E", "line 3: E;"),
        ("def f(): raise KeyboardInterrupt", "line 1: KeyboardInterrupt;"),
        ("def f(): raise Exception('x' * 10**6)", "xxx...;"),
        ("def f(): raise ExceptionGroup('two', [ValueError(1)])", "ExceptionGroup: two (1 sub"),
        ("def f(): return eval('1 +')", "line 1: SyntaxError: invalid syntax"),
        ("import sys\ndef f():\n    sys.setrecursionlimit(60)\n    return f()", "RecursionError"),
        ("def f(): return input('size? ')", "input() finds nothing here: use the arguments"),
        ("import sys\ndef f(): sys.exit('bye')", "it ends the program (SystemExit: bye); a func"),
        ("def f(): exit()", "rays.py, line 1: it ends the program (SystemExit); a function"),
        ("def f(a): return 1", "TypeError: f() missing 1 required positional argument: 'a'"),
        ("f = __import__('functools').partial(int, 'x')", "rays.py: ValueError: invalid literal"),
        ("f = 3", "has no function f"),
        ("def f(): raise ValueError('\\x1b[31m\\0\\udcff')", "ValueError: \\x1b[31m\\x00\\udcff;"),
    ],
)
def test_unusual_exceptions_are_told_and_the_next_call_is_answered(student, source, told):
    one = student(source + "\ndef g(): return [[1.0]]\n")
    run = one.call([F, called("g"), F])
    failure, right, again = run.values
    assert told in failure.text
    assert len(failure.text) < 500
    assert right == [[1.0]]
    assert failure.kind != "syntax"
    assert again.text == failure.text
    assert all(line.isprintable() for line in (failure.text, *failure.traceback))


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("import sys; sys.exit()", "it ends the program (SystemExit); put what runs on its own"),
        ("n = int(input())", "input() finds nothing here: put what runs on its own under"),
        ("raise KeyboardInterrupt", "rays.py, line 1: KeyboardInterrupt"),
        (
            "class A:\n  __module__ = property(lambda s: 1 / 0)\n  __call__ = max\na = A()",
            "Zero",
        ),
        ("from renderer import nothing", "ModuleNotFoundError: No module named 'renderer'"),
    ],
)
def test_what_ends_a_file_while_it_is_imported(student, source, told):
    assert told in student(source).call([F]).failure.text


def test_a_file_that_is_deleted_or_written_anew_while_it_runs(student, tmp_path):
    path = tmp_path / "rays.py"
    one = student(
        f"""
        import os
        os.remove({json.dumps(str(path))})
        def f():
            open({json.dumps(str(path))}, "w").write("# another\\n" * 9)
            return 1 / 0
        """
    )
    failure, again = one.call([F, F]).values
    assert failure.traceback[1:3] == again.traceback[1:3]
    assert failure.traceback[2] == "    return 1 / 0"


def test_a_name_that_no_terminal_shows(student):
    (failure,) = student("def f(): return object()", "a\n'\x1b.py").call([F]).values
    assert failure.text.startswith("a '\\x1b.py: f returned <object")


def test_the_arguments_of_a_call_are_told_in_a_line(student):
    given = {"image": [[[0.25] * 3] * 64] * 48, "text": "x" * 999, "camera": CAMERA}
    (failure,) = (
        student("def f(image, text, camera): return object()").call([called("f", **given)]).values
    )
    told = failure.text.partition("called as ")[2]
    assert told.startswith("f(image=(((0.25, 0.25, 0.25), (0.25, 0.25, 0.25), ")
    assert "), ...), text='xxx" in told
    assert told.endswith("xxx', ...)")
    assert len(told) < 400


def test_the_modules_beside_it_are_known_also_those_that_fail(student, tmp_path):
    (tmp_path / "vectors.py").write_text("import sums, json\n")
    (tmp_path / "sums.py").write_text("total = 0\n")
    one = student("import numpy, vectors\ndef f(): return 1\n")
    one.functions()
    assert names_of(one) == {"vectors.py", "sums.py"}
    for broken in ("total = ", "total = 1 / 0", "import absent"):
        (tmp_path / "sums.py").write_text(broken)
        one = student("import vectors\ndef f(): return 1\n")
        with pytest.raises(NotRunnableError, match=r"^sums\.py, line 1: "):
            one.functions()
        found = names_of(one)
        assert found >= {"vectors.py", "sums.py"}
        assert ("absent.py" in found) is ("absent" in broken)


def test_each_run_tells_its_first_exceptions_in_full(student):
    one = student("def f(i): raise ValueError(i)\n")
    for _ in range(2):
        values = one.call([called("f", i=i) for i in range(5)]).values
        assert [bool(failure.traceback) for failure in values] == [True] * 3 + [False] * 2


def names_of(one: FileStudent) -> set[str]:
    return {os.path.basename(path) for path in one.files}
