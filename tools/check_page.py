"""All steps of a lecture's page, in a browser: axe in every theme, layout at every size, keyboard.

    lucida lecture --export lecture.html && python -m tools.check_page lecture.html

Prints a line for each problem; the exit status is 1 if there was any.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from tests.support.browser import axe_script, chromium

THEMES = ("dark", "light", "contrast")
SIZES = ((1280, 720), (1920, 1080), (360, 740), (320, 180))  # the last: 1280x720 at 400 %
STARTS_MS = 400  # until a figure is there
CONTROLS = "a[href], button, input, select, textarea, summary, [tabindex='0']"
# What is wrong with the place of things in the step that is shown.
LAYOUT = """() => {
  const found = [], { scrollWidth, clientWidth } = document.documentElement;
  if (scrollWidth > clientWidth) found.push(`is ${scrollWidth - clientWidth} pixels too wide`);
  const step = document.querySelector(".step.current");
  const isShown = (one) =>
    one.checkVisibility({visibilityProperty: true}) && one.getBoundingClientRect().width > 0;
  const texts = "p, li, button, label, h2, dd, dt, figcaption, td, th, legend, summary, select";
  for (const one of step.querySelectorAll(texts))
    if (isShown(one) && !one.closest("pre, math, .formula") && one.scrollWidth > one.clientWidth + 1
        && getComputedStyle(one).display !== "inline" && !one.querySelector("math"))
      found.push(`cut off: ${one.textContent.trim().slice(0, 50)}`);
  const groups = ".words, .text, .views, form, .fields, .live-figure, .lucida-figure, "
    + ".lucida-aside, .lucida-number, .program li";
  for (const parent of [document.querySelector(".bar"), step, ...step.querySelectorAll(groups)]) {
    const shown = [...parent.children].filter(isShown);
    const boxes = shown.map((one) => [one, one.getBoundingClientRect()]);
    boxes.forEach(([one, a], k) => boxes.slice(k + 1).forEach(([other, b]) => {
      const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      const names = [one, other].map(({className, tagName}) => className || tagName);
      if (across > 2 && down > 2) found.push(`overlap: ${names.join(", ")}`);
    }));
  }
  return found;
}"""
# The controls of the bar and of the step that is shown.
WANTED = """(controls) => {
  const parts = [...document.querySelectorAll(".bar, .step.current")];
  const all = parts.flatMap((part) => [...part.querySelectorAll(controls)]);
  window.wanted = all.filter((one) => one.checkVisibility({visibilityProperty: true})
    && !one.disabled && one.getAttribute("visibility") !== "hidden"
    && !(one.type === "radio" && !one.checked));
  return window.wanted.length;
}"""
# The place of the focused control among these, and whether its focus can be seen.
FOCUSED = """() => {
  const one = document.activeElement, style = getComputedStyle(one);
  const isSeen = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2;
  const name = one.getAttribute("aria-label") ?? one.textContent.trim().slice(0, 40);
  return [window.wanted.indexOf(one), isSeen, `${one.tagName.toLowerCase()} ${name}`];
}"""


def main(argv: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("--steps", nargs="+", help="such as 3, or 3.2; all by default")
    asked = parser.parse_args(argv)
    count = 0
    with chromium() as browser:
        for name, check in (("axe", _axe), ("layout", _layout), ("keyboard", _keyboard)):
            context = browser.new_context(bypass_csp=True, viewport={"width": 1280, "height": 720})
            tab = context.new_page()
            tab.goto(asked.page.resolve().as_uri())
            numbers = asked.steps or [
                one.get_attribute("id") for one in tab.locator("section.step").all()
            ]
            for problem in dict.fromkeys(check(tab, numbers)):
                print(f"{name}: {problem}", flush=True)
                count += 1
            context.close()
    print(f"{count} problems")
    return int(count > 0)


def _go(tab: Any, number: str) -> None:
    tab.evaluate(f"location.hash = '#{number}'")
    tab.wait_for_timeout(STARTS_MS)


def _axe(tab: Any, numbers: Sequence[str]) -> Iterator[str]:
    """Yield what axe finds, in every theme, as a step begins, and answered."""
    tab.evaluate(axe_script())
    for number in numbers:
        _go(tab, number)
        for theme in THEMES:
            tab.evaluate("theme => document.documentElement.dataset.theme = theme", theme)
            yield from _violations(tab, f"step {number}, {theme}")
        for details in tab.locator(".current details").all():
            details.evaluate("one => one.open = true")
        for field in tab.locator(".current form input").all():
            field.fill("(1, 2, 3)")
        for button in tab.locator(".current .fields button, .current .options button").all()[:1]:
            button.click()
        tab.wait_for_timeout(STARTS_MS)
        for theme in THEMES:
            tab.evaluate("theme => document.documentElement.dataset.theme = theme", theme)
            yield from _violations(tab, f"step {number}, {theme}, answered")


def _violations(tab: Any, where: str) -> Iterator[str]:
    """Yield what axe finds in the step that is shown. Hidden steps would take most of the time."""
    context = "{exclude: ['.step:not(.current)']}"
    results = tab.evaluate(f"axe.run({context}, {{resultTypes: ['violations']}})")
    for one in results["violations"]:
        yield f"{where}: {one['id']}: {one['nodes'][0]['html'][:120]}"


def _layout(tab: Any, numbers: Sequence[str]) -> Iterator[str]:
    for width, height in SIZES:
        tab.set_viewport_size({"width": width, "height": height})
        for number in numbers:
            _go(tab, number)
            for problem in tab.evaluate(LAYOUT):
                yield f"{width}x{height}, step {number}: {problem}"


def _keyboard(tab: Any, numbers: Sequence[str]) -> Iterator[str]:
    """Yield the controls that Tab does not reach, in their order, with a visible focus."""
    for number in numbers:
        _go(tab, number)
        tab.wait_for_timeout(STARTS_MS)
        count = tab.evaluate(WANTED, CONTROLS)
        tab.evaluate("document.body.tabIndex = -1; document.body.focus()")
        places = []
        for _ in range(count + 2):
            tab.keyboard.press("Tab")
            place, is_seen, name = tab.evaluate(FOCUSED)
            if place < 0 or place in places:
                break
            places.append(place)
            if not is_seen:
                yield f"step {number}: no visible focus: {name}"
        missing = sorted(set(range(count)) - set(places))
        for place in missing:
            name = tab.evaluate("place => window.wanted[place].outerHTML.slice(0, 100)", place)
            yield f"step {number}: Tab does not reach {name}"
        if places != sorted(places):
            yield f"step {number}: out of order: {places}"


if __name__ == "__main__":
    raise SystemExit(main())
