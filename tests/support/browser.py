"""Chromium, driven by Playwright, for the tests of pages."""

from __future__ import annotations

import base64
import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from needed import need
from waiting import wait_for

CHROMIUM = "chromium", "chromium-browser"


@contextlib.contextmanager
def chromium() -> Iterator[Any]:
    """Yield a browser."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        arguments = ["--no-sandbox", "--enable-unsafe-swiftshader"]
        browser = playwright.chromium.launch(executable_path=need(*CHROMIUM), args=arguments)
        yield browser
        browser.close()


def axe_script() -> str:
    """Return axe-core, which finds what keeps people from using a page."""
    import axe_playwright_python

    return Path(axe_playwright_python.__file__).with_name("axe.min.js").read_text(encoding="utf-8")


class Page:
    """An open page. at: the end of its address.

    problems: errors, console messages, dialogs, and requests that left.
    """

    def __init__(self, browser: Any, file: Path, at: str = "", **settings: Any) -> None:
        self.problems: list[str] = []
        self.tab = browser.new_page(**settings)
        self.tab.on("console", self._hear)
        self.tab.on("dialog", self._dismiss)
        self.tab.on("pageerror", lambda error: self.problems.append(str(error)))
        self.tab.on("request", lambda request: self._note(request.url))
        self.tab.goto(file.as_uri() + at)

    def _hear(self, message: Any) -> None:
        if "GL Driver Message" not in message.text:  # software WebGL is slow, and says so
            self.problems.append(message.text)

    def _dismiss(self, dialog: Any) -> None:
        self.problems.append(dialog.message)
        dialog.dismiss()

    def _note(self, url: str) -> None:
        if not url.startswith(("file:", "blob:", "data:")):
            self.problems.append(url)

    def until(self, expression: str) -> None:
        """Wait until an expression is true. (Playwright's own waiting needs eval, which pages
        forbid.)
        """
        wait_for(lambda: self.tab.evaluate(expression))

    def drawn(self) -> None:
        """Wait until the figure has drawn its camera, and the workers have answered the probe.

        The figure asked for the frame before, and a worker answers in the order of the questions.
        """
        asked = "requestAnimationFrame(() => lucida.pixels('ray', [8, 8]).then(() => done()))"
        self.tab.evaluate(f"new Promise((done) => {asked})")

    def axe(self, options: str = "") -> list[Any]:
        """Return what axe finds. (DevTools evaluate it where the page's policy forbids it.)"""
        if not self.tab.evaluate("'axe' in window"):
            session = self.tab.context.new_cdp_session(self.tab)
            session.send("Runtime.evaluate", {"expression": axe_script()})
        run = f"axe.run({{{options} resultTypes: ['violations']}})"
        return self.tab.evaluate(run)["violations"]

    def image(self, kind: str, size: tuple[int, int]) -> np.ndarray:
        """Return a finished image of window.lucida: uint8 (height, width, 3)."""
        script = """async ([kind, size]) => {
          const { data } = await lucida.pixels(kind, size);
          return btoa(Array.from(data, (byte) => String.fromCharCode(byte)).join(""));
        }"""
        pixels = base64.b64decode(self.tab.evaluate(script, [kind, list(size)]))
        return np.frombuffer(pixels, np.uint8).reshape(size[1], size[0], 4)[..., :3]


def unexplained(image: np.ndarray, right: np.ndarray, primitive: np.ndarray) -> np.ndarray:
    """Return the pixels that differ by more than 1/255 from the right image and are not on an edge,
    of a primitive or of what it shows: bool (height, width).
    """
    unlike = (np.abs(image.astype(int) - right) > 1).any(axis=2)
    around, colors = _around(primitive), _around(right.astype(int))
    is_edge = (around != primitive).any(axis=0)
    within = (image >= colors.min(axis=0) - 1) & (image <= colors.max(axis=0) + 1)
    return unlike & ~is_edge & ~within.all(axis=2)


def _around(array: np.ndarray) -> np.ndarray:
    """Return the nine neighbours of each pixel: (9, height, width, ...)."""
    height, width = array.shape[:2]
    padded = np.pad(array, [(1, 1), (1, 1)] + [(0, 0)] * (array.ndim - 2), mode="edge")
    return np.stack([padded[i : i + height, j : j + width] for i in range(3) for j in range(3)])
