"""A user's mistake is one line, whatever it is about."""

from renderer.errors import LucidaError


def test_an_error_tells_source_field_problem_and_remedy():
    error = LucidaError("w", "(0, 0, 0) is not independent", "give w a part").within("camera")
    assert str(error.in_file("view.toml")) == (
        "view.toml: camera.w: (0, 0, 0) is not independent; give w a part"
    )


def test_parts_that_are_missing_leave_no_trace():
    assert str(LucidaError("", "no display")) == "no display"
    assert str(LucidaError("", "no display").within("window")) == "window: no display"


def test_control_characters_and_line_breaks_do_not_reach_the_terminal():
    error = LucidaError("name", "line one\n  line two \x1b[31m").in_file("bell\x07.obj")
    assert str(error) == "bell\\x07.obj: name: line one line two \\x1b[31m"
