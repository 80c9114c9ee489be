"""A user's mistake is one line, whatever it is about."""

from lucida.renderer.system.errors import LucidaError, one_line, shortened, visible


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


def test_what_a_file_makes_long_is_shown_short():
    line = str(LucidaError("f" * 9000, "p" * 9000, "r" * 9000, "file.toml"))
    assert line.startswith("file.toml: fff")
    assert len(line) < 2000
    assert shortened("abcdefghij", 8) == "abcd...j"
    assert shortened("abcdefgh", 8) == "abcdefgh"


def test_bytes_that_are_no_text_are_shown_as_such():
    assert one_line("a\udcff\ud800\x1b\n b") == r"a\xff\ud800\x1b b"


def test_what_a_terminal_only_shows_is_not_escaped():
    text = 'a "quoted" \\path\n\tindented \u200cand joined\u200d: \u00e9 \u6f22'
    assert visible(text) == text
