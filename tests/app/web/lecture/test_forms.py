"""The fields of an exercise's form, and a step's notes, on a lecture's page."""

from __future__ import annotations

import re

from lucida.app.lecture.reading import lecture_from_toml
from lucida.app.web.lecture.page import page


def test_fields_are_named_by_their_vectors_bold_and_in_their_colours(lecture):
    html = page(lecture, [[]] * len(lecture.builds))
    labels = re.findall(r'<label for="field-([\d.]+)-\d">(.*?)</label>', html)
    by_step = {}
    for step, label in labels:
        by_step.setdefault(step, []).append(label)
    p, d, u, v, w = (f' <strong class="vector-{letter}">{letter}</strong>' for letter in "pduvw")
    ray = [f"origin{p}", f"direction{d}"]
    assert list(by_step.values()) == [
        ray,
        [w, u, v],
        ray,
        [" <strong>e</strong>", w, "left, top, d"],
    ]


def test_notes_are_only_in_a_page_with_answers(tmp_path):
    text = (
        "title = 'L'\n[[steps]]\ntitle = 'T'\ntext = 'One.'\nnotes = 'Whose d?'\n"
        "[[steps]]\ntitle = 'S'\ntext = 'Two.'\n"
    )
    lecture = lecture_from_toml(text, tmp_path, "x")
    for answers in (True, False):
        html = page(lecture, [[]] * 2, answers)
        assert html.count('<div class="notes" hidden>') == int(answers)
        assert ("Whose d?" in html) == answers
