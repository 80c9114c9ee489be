"""The first trace of an installation says why it takes seconds; later ones say nothing."""

from types import SimpleNamespace

import pytest

from lucida.app.commands.arguments import progress_bar
from lucida.app.window.status import is_good_news, told
from lucida.renderer.system import compile_note


@pytest.fixture(autouse=True)
def nothing_noted(monkeypatch):
    # It counts for a whole process, and nothing but its end takes it back.
    monkeypatch.setattr(compile_note, "_note", "")


def test_the_command_line_says_it_once_also_where_nobody_sees_a_bar(capsys):
    with progress_bar("ray") as report:
        report(0.0)
        assert capsys.readouterr().err == ""
        compile_note.begin(kept=True)
        report(0.0)
        report(0.5)
        compile_note.begin(kept=True)
        report(1.0)
    assert capsys.readouterr().err == f"lucida: {compile_note.ONCE}\n"


def test_the_status_line_s_words_while_nothing_is_known():
    assert told(None, None) == ""
    assert is_good_news(None, None) is None
    assert is_good_news(None, ValueError("x")) is False
    verdict = SimpleNamespace(text="all pixels agree", agrees=True)
    assert told(verdict, ValueError("old")) == "all pixels agree"
    assert is_good_news(verdict, ValueError("old")) is True
