"""Formulas that cannot be set: which command, where it stands in the file."""

import pytest
from both_lectures import both_lectures

from lucida.app.lecture.reading import lecture_from_toml
from lucida.app.lecture.typesetting import first_mistake, mistake
from lucida.app.ui import formula

pytestmark = pytest.mark.skipif(
    not formula.available(), reason="formulas are set only with the locale en_US.UTF-8"
)


@pytest.mark.parametrize(
    "latex",
    [
        "a + b",
        r"\left( \frac{1}{2} \right)",
        r"\begin{cases}1 & 2\\3 & 4\end{cases}",
        r"\textcolor{red}{x} + \left( y \right)",  # red that is meant
        r"\mathbf{d} = u\,\mathbf{u}",
        "é",
    ],
)
def test_what_can_be_set(latex):
    assert mistake(latex) is None


@pytest.mark.parametrize(
    ("latex", "at", "told"),
    [
        (r"\foo + 1", 0, r"\foo is no command"),
        (r"\frac{1}{2} + \qwe{3}", 14, r"\qwe is no command"),
        (r"\left( \foo \right)", 7, r"\foo is no command"),
        (r"\textcolor{red}{\foo}", 16, r"\foo is no command"),
        (r"\right)", 0, r"\right in '\right)' has no partner"),
        (r"\begin{foo}x\end{foo}", 0, "of an unknown kind"),
        ("a & b", 0, "'a & b' cannot be set: "),
    ],
)
def test_what_cannot_be_set(latex, at, told):
    found = mistake(latex)
    assert found is not None
    assert found[0] == at and told in found[1]


def test_the_line_is_that_of_the_command(tmp_path):
    text = """\
title = "x"
[[steps]]
title = "a"
text = '''
Some $x$ and
> a question $a
> b$

$$
\\frac{1}{2}
+ \\unheard
$$
'''
"""
    lecture = lecture_from_toml(text, tmp_path, "x.toml")
    assert [(one.latex, one.line) for one in lecture.formulas] == [
        ("x", 5),
        ("a\nb", 6),
        ("\\frac{1}{2}\n+ \\unheard", 10),
    ]
    told = first_mistake(lecture.formulas)
    assert str(told).startswith(r"x.toml:11: steps[0].text: \unheard is no command")


def test_all_formulas_of_the_built_in_lecture_can_be_set():
    lecture = both_lectures()
    assert len(lecture.formulas) > 30
    assert first_mistake(lecture.formulas) is None
