"""A lecture as a page, in a browser: keys, answers, prints; hostile texts; axe."""

import re

import numpy as np
import pytest
from hostile_lecture import FORMULAS, TEXTS, hostile_lecture
from needed import need

from lucida.app.cli import main
from lucida.app.lecture.exercises import RayExercise
from lucida.app.lecture.reading import lecture_from_toml
from lucida.app.lecture.results import read_answers
from lucida.app.lecture.text import parse
from lucida.app.web import pdf
from lucida.app.web.lecture.mathml import inline
from lucida.app.web.lecture.page import Still, page
from lucida.app.web.lecture.text import blocks_html
from tests.support.browser import CHROMIUM, Page

TITLES = (  # of steps with one of everything
    "Where do viewing rays come from?", "Raster images", "Parallel projection", "Ray tracing",
    "Exercise: hide the box", "From pixel to (u, v)", "One pixel, worked out",
    "Exercise: any camera's ray", "The camera as K", "Exercise: which lens?",
)  # fmt: skip


@pytest.fixture(scope="module")
def written(lecture, tmp_path_factory):
    """Some steps of the built-in lecture as a page, with pictures of one colour."""
    import dataclasses

    builds = [
        dataclasses.replace(one, number=number)
        for number, title in enumerate(TITLES)
        for one in lecture.builds
        if one.title == title
    ]
    some = dataclasses.replace(lecture, builds=tuple(builds))
    gray = np.full((30, 40, 3), 128, np.uint8)
    stills = [[Still(step.views[0], gray, dark=gray)] for step in some.builds]
    path = tmp_path_factory.mktemp("page") / "lecture.html"
    path.write_text(page(some, stills), encoding="utf-8")
    return path, some


@pytest.fixture(scope="module")
def shared(browser, written):
    """The page in a browser, for all tests; what goes wrong there fails the last of them."""
    page = Page(browser, written[0], device_scale_factor=0.25, has_touch=True)
    page.tab.add_init_script("WebGL2RenderingContext.prototype.drawArrays = () => {}")  # is slow
    yield page
    page.tab.close()
    assert page.problems == []


@pytest.fixture
def opened(shared, written):
    """The page at its first step, as somebody opens it who was never there."""
    tab = shared.tab
    for notes in tab.context.pages[1:]:
        notes.close()
    tab.set_viewport_size({"width": 1280, "height": 720})
    tab.emulate_media(media="screen", reduced_motion="reduce")
    tab.evaluate("localStorage.clear()")
    tab.goto(written[0].as_uri())
    return tab


def place(tab):
    return tab.inner_text("#place")


def go(tab, number):
    tab.evaluate(f"location.hash = '#{number}'")
    tab.get_by_text(f"{number} / {len(TITLES)}", exact=True).wait_for()


def test_keys_walk_all_builds(opened, written):
    _, some = written
    press = "document.body.dispatchEvent(new KeyboardEvent('keydown', press))"
    script = f"const press = {{ key: 'ArrowRight', bubbles: true }}; while (count--) {press};"
    opened.evaluate(f"(count) => {{ {script} }}", len(some.builds) - 2)
    assert not opened.is_disabled("#next")
    opened.keyboard.press("ArrowRight")
    assert opened.is_disabled("#next")
    assert place(opened) == f"{len(TITLES)} / {len(TITLES)}"
    opened.keyboard.press("Home")
    assert place(opened).startswith("1 /")
    opened.keyboard.press("ArrowRight")
    assert place(opened).startswith("1 /") and opened.url.endswith("#1.2")
    go(opened, 4)
    opened.keyboard.press("o")
    assert opened.locator("#overview a").count() == len(TITLES)
    assert opened.evaluate("document.activeElement.getAttribute('href')") == "#4"
    opened.locator("#overview a").nth(2).click()
    opened.get_by_text(f"3 / {len(TITLES)}").wait_for()
    opened.set_viewport_size({"width": 360, "height": 300})
    go(opened, len(TITLES))
    opened.locator(".current").evaluate("step => step.scrollIntoView()")  # as an address does
    assert opened.evaluate("scrollY") == 0  # the bar is in sight


def try_it(tab):
    tab.locator(".current .try summary").click()
    tab.locator(".current .lucida-figure").wait_for()
    tab.evaluate("lucida.ready")


def test_swipes_and_typed_numbers_go_to_builds(opened):
    opened.set_viewport_size({"width": 360, "height": 740})

    finger = opened.context.new_cdp_session(opened)

    def swipe(*way):
        moves = [("touchMove", [one]) for one in way[1:]]
        for kind, points in (("touchStart", way[:1]), *moves, ("touchEnd", ())):
            touches = [{"x": x, "y": y} for x, y in points]
            finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

    swipe((300, 200), (200, 205), (100, 210))
    opened.locator(".current[id='1.2']").wait_for()
    swipe((200, 200), (150, 202), (140, 120))  # aslant: one swipe back is enough
    swipe((100, 200), (200, 205), (300, 210))
    opened.locator(".current[id='1']").wait_for()
    for key in "10":
        opened.keyboard.press(key)
    opened.keyboard.press("Enter")
    assert place(opened) == "10 / 10"
    opened.keyboard.press("7")
    opened.keyboard.press("7")
    opened.keyboard.press("Enter")
    assert place(opened) == "10 / 10" and "no step 77" in opened.inner_text("#told")


def test_a_cross_fade_ends_at_the_last_build_that_was_asked_for(opened, written):
    opened.emulate_media(reduced_motion="no-preference")
    for _ in range(4):
        opened.keyboard.press("ArrowRight")
    shown = written[1].builds[4]
    opened.locator(f".current[id='{shown.number + 1}.{shown.build + 1}']").wait_for()


def test_notes_follow_in_a_window_of_their_own(opened, written):
    with opened.expect_popup() as popup:
        opened.keyboard.press("n")
    notes = popup.value
    notes.get_by_text("Next", exact=True).click()
    notes.keyboard.press("End")
    assert place(opened).startswith(f"{len(TITLES)} /")
    last = written[1].steps[-1]
    assert notes.inner_text("h2") == last.title


def test_answers_are_judged_drawn_and_saved(opened, written, tmp_path):
    _, some = written
    number = next(k for k, step in enumerate(some.steps) if isinstance(step.exercise, RayExercise))
    step = some.steps[number]
    go(opened, number + 1)
    ray = step.exercise.camera.ray(*step.exercise.pixel, step.exercise.size)
    wrong = -np.asarray(ray.direction)
    origin = np.asarray(ray.origin).tolist()
    texts = {"origin": str(origin), "direction": str(wrong.tolist())}
    current = opened.locator(".current form")
    for name, text in texts.items():
        current.locator(f"input[name='{name}']").fill(text)
    current.locator("button", has_text="Check").click()
    expected = step.exercise.check(texts)
    assert not expected.right
    assert current.locator(".reply").inner_text().removeprefix("\u2717").strip()
    assert current.locator("svg path.given").count()
    assert current.locator("input[name='direction']").get_attribute("aria-invalid") == "true"
    opened.reload()
    assert opened.locator(".step.current").get_attribute("id") == str(number + 1)
    assert opened.locator(f"form[data-step='{number + 1}'] input").first.input_value()
    opened.click("#open-answers")
    opened.fill("#student", "Ada")
    with opened.expect_download() as download:
        opened.click("#save")
    download.value.save_as(tmp_path / "answers.jsonl")
    answers, problems = read_answers([tmp_path / "answers.jsonl"])
    assert problems == []
    assert [(one.name, one.step, one.right) for one in answers] == [("Ada", step.title, False)]
    assert answers[0].mistake == expected.mistake
    assert main(["lecture", "--results", str(tmp_path / "answers.jsonl"),
                 "-o", str(tmp_path / "class.html")]) == 0  # fmt: skip


def test_handles_are_dragged_and_a_remote_is_heard_wherever_the_focus_is(opened, written):
    opened.set_viewport_size({"width": 1280, "height": 2000})

    def handle(name):
        found = opened.locator(f".current .lucida-handles [aria-label='{name}']")
        found.wait_for()
        return found

    try_it(opened)
    eye = opened.evaluate("lucida.camera.eye")
    assert eye == list(written[1].steps[0].view.camera.eye)
    x, y = handle("Eye along v").evaluate(
        "({firstChild: p}) => { const { x, y } = p.getPointAtLength(20)"
        ".matrixTransform(p.getScreenCTM()); return [x, y]; }"
    )
    opened.mouse.move(x, y)
    opened.mouse.down()
    opened.mouse.move(x, y - 20)
    opened.mouse.up()
    dragged = opened.evaluate("lucida.camera.eye")
    assert np.dot(np.subtract(dragged, eye), opened.evaluate("lucida.camera.v")) > 0
    handle("Eye along u").focus()
    opened.keyboard.press("ArrowRight")
    moved = np.subtract(opened.evaluate("lucida.camera.eye"), dragged)
    assert np.dot(moved, opened.evaluate("lucida.camera.u")) > 0
    for focused in ("canvas", "[role=slider]"):
        part = opened.locator(f".current .lucida-figure {focused}").first
        part.focus()
        opened.keyboard.press(".")
        assert opened.locator("body.blank").count() == 1
        opened.keyboard.press("PageDown")  # it shows the screen again, and no more
        assert opened.locator("body.blank").count() == 0
        assert place(opened).startswith("1 /")
        part.focus()
        opened.keyboard.press("PageDown")
        assert opened.url.endswith("#1.2")
        opened.keyboard.press("PageUp")
    opened.keyboard.press("PageDown")
    try_it(opened)
    handle("View direction").focus()
    before = opened.evaluate("lucida.camera")
    opened.keyboard.press("ArrowRight")
    after = opened.evaluate("lucida.camera")
    assert after["eye"] == before["eye"]
    assert np.dot(after["w"], before["u"]) < 0  # w points back, so the view turns to the right
    go(opened, 1 + TITLES.index("Exercise: hide the box"))
    handle("ball along x").focus()
    opened.keyboard.press("ArrowRight")
    opened.get_by_text("of the box can still be seen").wait_for()


def test_a_view_in_the_themes_colours_has_a_picture_of_each(opened):
    for theme, is_dark in (("light", False), ("dark", True), ("contrast", True)):
        opened.evaluate("theme => document.documentElement.dataset.theme = theme", theme)
        shown = [image.is_visible() for image in opened.locator(".current .view img").all()]
        assert shown == [not is_dark, is_dark]
    opened.emulate_media(media="print")
    assert not opened.locator(".view .dark:visible").count()


def test_a_formula_keeps_only_the_stop_after_it():
    html = blocks_html(parse("An image of $8$ pixels, from $0$."))
    assert [re.sub("<.*?>", "", part) for part in re.findall(r'kept">(.*?)</span>', html)] == ["0."]


def test_hostile_texts_are_only_texts(browser, tmp_path):
    hostile = hostile_lecture(tmp_path)
    path = tmp_path / "hostile.html"
    path.write_text(page(hostile, [()] * len(hostile.builds)), encoding="utf-8")
    opened = Page(browser, path)
    tab = opened.tab
    for field in tab.locator("form.exercise").all()[:: len(TEXTS) // 3]:
        field.evaluate("form => { form.elements[0].value = '(0, 1, 0)'; form.requestSubmit(); }")
    assert len(TEXTS) + len(FORMULAS) >= 60
    assert tab.locator("section.step").count() == len(hostile.steps)
    assert tab.evaluate("window.hurt") is None
    assert tab.title() == hostile.title
    assert tab.locator("script").count() == 2
    strange = "iframe, object, embed, link, base, img, svg image, [onerror], [onload], [style]"
    assert tab.locator(f".words :is({strange})").count() == 0
    assert tab.locator(".words [href]").count() == 0
    tab.close()
    assert opened.problems == []


@pytest.mark.parametrize("latex", FORMULAS)
def test_a_formula_writes_known_elements_only(latex):
    html = inline(latex)
    assert not re.search(r"<(?!/?(?:math|m\w+|none|code)\b)", html)
    assert not re.search(r"<[^>]*\b(?:href|style|id|on\w+|src|background)\s*=", html)


# Remove the builds all of whose text has the colours, the size and the weight of an earlier one's.
ONE_OF_EACH_LOOK = """() => { const seen = new Set();
  window.steps ??= [...document.querySelectorAll(".step")];
  const { parentElement } = document.querySelector(".step");
  for (const step of steps) {
    parentElement.append(step);
    const count = seen.size;
    for (const one of step.querySelectorAll("*")) {
      const { color, fontSize, fontWeight } = getComputedStyle(one);
      const look = [color, fontSize, fontWeight];
      for (let at = one; at; at = at.parentElement) look.push(getComputedStyle(at).backgroundColor);
      seen.add(look.filter((part) => part !== "rgba(0, 0, 0, 0)").join());
    }
    if (seen.size === count) step.remove();
  } }"""


def test_axe_finds_nothing_in_any_theme(opened, shared):
    """All builds are shown at once; for contrast, one of each look."""
    found = shared.axe(options="runOnly: ['landmark-unique'], ")  # builds of a step share a title
    opened.evaluate("document.querySelectorAll('.step').forEach((s) => s.classList.add('current'))")
    apart = "rules: {'landmark-unique': {enabled: false}, 'color-contrast': {enabled: false}}, "
    found += shared.axe(options=apart)
    for theme in ("dark", "light", "contrast"):
        opened.evaluate("theme => document.documentElement.dataset.theme = theme", theme)
        opened.evaluate(ONE_OF_EACH_LOOK)
        assert opened.locator(".step.current").count() > 3
        contrast = shared.axe(options="runOnly: ['color-contrast'], ")
        found += [{**one, "theme": theme} for one in contrast]
    assert [(one.get("theme"), one["id"], one["nodes"][0]["html"]) for one in found] == []


def test_a_print_has_a_page_for_each_picture(written):
    need(*CHROMIUM)
    _, some = written
    gray = np.full((900, 550, 3), 128, np.uint8)
    stills = [[Still(v, gray) for v in step.views] for step in some.builds]
    assert "Show the solution" not in page(some, stills, False, True)
    html = page(some, stills, True, True)
    assert "Show the solution" in html
    printed = pdf.pdf(html, pdf.browser())
    pages = len(re.findall(rb"/Type\s*/Page\b", printed))
    assert pages == html.count("<section class") >= len(TITLES)


def test_a_print_leaves_out_builds_on_the_way_to_the_next(tmp_path):
    text = (
        "title = 'L'\n[[steps]]\ntitle = 'T'\ntext = 'One.\\n> Why?'\n"
        "[[steps.builds]]\ntext = 'Two.'\noptions.shadows = true\n"
        "[[steps.builds]]\noptions.images.samples = 4\noptions.mirrors = true\n"
        "[[steps.builds]]\ninstead = 'Three.'\n"
    )
    lecture = lecture_from_toml(
        text.replace("'One.\\n> Why?'", '"One.\\n\\n> Why?"'), tmp_path, "x"
    )
    none = [()] * len(lecture.builds)
    for answers, for_print, shown in (
        (True, True, ["1.2", "1.3", "1.4"]), (True, False, ["1", "1.2", "1.3", "1.4"]),
        (False, True, ["1"]),
    ):  # fmt: skip
        html = page(lecture, none, answers, for_print)
        assert re.findall(r'<section [^>]*id="([\d.]+)"', html) == shown
        assert (' passing"' in html) == (answers and not for_print)


def test_no_browser_costs_one_line(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(pdf.shutil, "which", lambda name: None)
    assert main(["lecture", "--export", str(tmp_path / "handout.pdf")]) == 2
    assert "needs Chromium or Chrome" in capsys.readouterr().err
