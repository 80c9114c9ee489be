"""Print a page as PDF with an installed browser."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from lucida.renderer.system.errors import LucidaError

BROWSERS = (
    *("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge"),
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
)
OPTIONS = (
    *("--headless", "--disable-gpu", "--disable-extensions", "--no-first-run"),
    *("--no-pdf-header-footer", "--generate-pdf-document-outline", "--virtual-time-budget=10000"),
)
LIMIT_S = 300.0


def browser() -> str:
    """Return the browser's program. Raises LucidaError if there is none."""
    for name in BROWSERS:
        if found := shutil.which(name):
            return found
    raise LucidaError(
        "PDF", "needs Chromium or Chrome", "install it, or print the .html or .svg yourself"
    )


def pdf(html: str, program: str) -> bytes:
    """Return a page as PDF. program: from browser(). Raises LucidaError."""
    with tempfile.TemporaryDirectory(prefix="lucida-print-", ignore_cleanup_errors=True) as folder:
        page, printed = Path(folder, "page.html"), Path(folder, "page.pdf")
        page.write_text(html, encoding="utf-8")
        command = [program, *OPTIONS, f"--user-data-dir={Path(folder, 'profile')}"]
        if sys.platform == "linux" and os.geteuid() == 0:
            command.append("--no-sandbox")  # root cannot have a sandbox; the page loads nothing
        command += [f"--print-to-pdf={printed}", page.as_uri()]
        try:
            subprocess.run(command, capture_output=True, timeout=LIMIT_S, check=False)
            return printed.read_bytes()
        except (OSError, subprocess.TimeoutExpired):
            raise LucidaError(
                "PDF", f"{Path(program).name} did not print", "print the .html or .svg yourself"
            ) from None
