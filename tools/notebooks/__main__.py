"""python -m tools.notebooks: drives the live widget in JupyterLab and in marimo, in Chromium.

It drags, turns the wheel, clicks, types keys and numbers, and counts the images of a drag. Needs
Debian's chromium; run it by `make notebooks`, which makes the environment with both programs.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, sync_playwright

ROOT = Path(__file__).resolve().parents[2]
CELLS = (
    "from lucida.renderer.notebook import explore\nwidget = explore({scene!r})\nwidget",
    "widget.camera = widget.scene.view.for_size((640, 480))\nwidget.pixel = (10, 20)",
)
DRAG_S = 4.0
FULL = ".lucida canvas[data-factor='1']"


def notebook(folder: Path, scene: str) -> Path:
    """Write a notebook for Jupyter."""
    cells = [
        {"cell_type": "code", "id": f"c{k}", "metadata": {}, "execution_count": None}
        | {"outputs": [], "source": text.format(scene=scene)}
        for k, text in enumerate(CELLS)
    ]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    book = {"nbformat": 4, "nbformat_minor": 5, "metadata": {"kernelspec": kernel}, "cells": cells}
    path = folder / "explore.ipynb"
    path.write_text(json.dumps(book))
    return path


def marimo_program(folder: Path, scene: str) -> Path:
    """Write the same for marimo."""
    cells = (
        f"@app.cell\ndef _():\n    from lucida.renderer.notebook import explore\n"
        f"    widget = explore({scene!r})\n    widget\n    return\n"
    )
    path = folder / "explore.py"
    path.write_text(f"import marimo\napp = marimo.App()\n\n{cells}\n")
    return path


@contextlib.contextmanager
def served(command: list[str], folder: Path) -> Iterator[None]:
    """Run a server until the block ends."""
    shared = ROOT / ".venv" / "share" / "jupyter"  # JupyterLab's part of the widgets' packages
    environment = os.environ | {"PYTHONPATH": str(ROOT), "JUPYTER_PATH": str(shared)}
    with (folder / "server.log").open("w") as log:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
        try:
            yield
        finally:
            process.terminate()
            process.wait(20)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def opened(page: Page, url: str) -> None:
    """Open a page of a server that may still be starting."""
    for _ in range(120):
        with contextlib.suppress(Exception):
            if page.goto(url, wait_until="domcontentloaded"):
                return
        time.sleep(0.5)
    raise TimeoutError(url)


def image(page: Page) -> str:
    """Return the full image that is shown, once it has come."""
    page.locator(FULL).wait_for(timeout=180_000)
    page.wait_for_timeout(600)
    page.locator(FULL).wait_for(timeout=60_000)
    shown: str = page.locator(".lucida canvas").evaluate("canvas => canvas.toDataURL()")
    return shown


def count(page: Page) -> int:
    return int(page.locator(".lucida canvas").get_attribute("data-images") or 0)


def drive(page: Page) -> dict[str, Any]:
    """Use the widget as a person would. Return what was measured; raise AssertionError."""
    canvas = page.locator(".lucida canvas")
    canvas.wait_for(timeout=180_000)
    seen = [image(page)]
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def changed(what: str) -> None:
        seen.append(image(page))
        assert seen[-1] != seen[-2], f"the image is the same after {what}"

    page.mouse.move(x, y)
    page.mouse.down()
    before, begun_s, moves = count(page), time.monotonic(), 0
    while (passed_s := time.monotonic() - begun_s) < DRAG_S:
        moves += 1
        page.mouse.move(x + 120 * passed_s / DRAG_S, y + 20 * (moves % 2))
        page.wait_for_timeout(8)
    per_second = (count(page) - before) / DRAG_S
    factor = canvas.get_attribute("data-factor")
    page.mouse.up()
    changed("a drag")
    page.mouse.move(x, y)
    page.mouse.down(button="right")
    page.mouse.move(x + 30, y + 20, steps=4)
    page.mouse.up(button="right")
    changed("a pan")
    page.mouse.wheel(0, -200)
    changed("the wheel")
    page.mouse.click(x, y)
    page.locator(".lucida table.hit").get_by_text("row 2").wait_for()
    canvas.press("ArrowLeft")
    changed("a key")
    angle = page.get_by_label("field of view").last
    angle.fill("50")
    angle.press("Enter")
    changed("a number")
    angle.fill("200")
    angle.press("Enter")
    page.get_by_text("200 is not between 0 and 180").wait_for()
    page.get_by_label("projection").select_option("parallel")
    changed("parallel rays")
    page.get_by_label("viewport height").last.wait_for()
    canvas.press("Home")
    page.wait_for_timeout(300)
    assert image(page) == seen[0], "Home does not show the first image"
    return {"images a second": round(per_second, 1), "moves": moves, "coarser": factor}


def in_jupyter(page: Page, folder: Path, scene: str) -> dict[str, Any]:
    notebook(folder, scene)
    port = free_port()
    command = [sys.executable, "-m", "jupyterlab", "--no-browser", f"--port={port}", "--allow-root"]
    command += ["--IdentityProvider.token=", f"--ServerApp.root_dir={folder}"]
    with served(command, folder):
        opened(page, f"http://127.0.0.1:{port}/lab/tree/explore.ipynb")
        first = page.locator(".jp-CodeCell .cm-content").first
        first.click(timeout=120_000)
        page.locator("[data-status=idle]").first.wait_for(timeout=60_000)
        first.press("Shift+Enter")
        found = drive(page)
        page.locator(".jp-CodeCell .cm-content").last.press("Shift+Enter")
        page.locator(".lucida table.hit").get_by_text("row 10, column 20").wait_for()
        page.screenshot(path=folder / "jupyter.png")
    return found


def in_marimo(page: Page, folder: Path, scene: str) -> dict[str, Any]:
    program, port = marimo_program(folder, scene), free_port()
    command = [sys.executable, "-m", "marimo", "run", str(program), "--headless", "--no-token"]
    with served([*command, "--port", str(port)], folder):
        opened(page, f"http://127.0.0.1:{port}/")
        found = drive(page)
        page.screenshot(path=folder / "marimo.png")
    return found


PLACES = {"jupyterlab": in_jupyter, "marimo": in_marimo}


def main() -> int:
    parser = argparse.ArgumentParser(prog="make notebooks ARGS=...", description=__doc__)
    parser.add_argument("--only", choices=PLACES)
    parser.add_argument("--scene", default="still-life")
    parser.add_argument("--keep", type=Path, help="a folder for pictures and logs")
    arguments = parser.parse_args()
    chromium = shutil.which("chromium")
    if chromium is None:
        print("notebooks: chromium is not installed", file=sys.stderr)
        return 2
    with contextlib.ExitStack() as stack:
        folder = arguments.keep or Path(stack.enter_context(tempfile.TemporaryDirectory()))
        folder.mkdir(parents=True, exist_ok=True)
        play = stack.enter_context(sync_playwright())
        browser = play.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        for name in [arguments.only] if arguments.only else PLACES:
            page = browser.new_page(viewport={"width": 1280, "height": 900})
            page.on("pageerror", lambda error: print(f"notebooks: {error}", file=sys.stderr))
            try:
                found = PLACES[name](page, folder.resolve(), arguments.scene)
            except BaseException:
                page.screenshot(path=folder / f"{name}-failed.png")
                raise
            told = ", ".join(f"{key}: {value}" for key, value in found.items())
            print(f"{name} {version(name)}, chromium {browser.version}: {told}", flush=True)
            page.close()
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
