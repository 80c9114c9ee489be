"""Firefox, driven by its WebDriver BiDi: Debian's does not know Playwright's own protocol.

It has as much of Playwright's page as support/browser.py asks for, and needs a display for WebGL.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from tornado.websocket import websocket_connect

EVENTS = {"log.entryAdded": "console", "network.beforeRequestSent": "request"}
_EVALUATE = """async (given) => {
  const value = (SCRIPT);
  return JSON.stringify(await (typeof value === "function" ? value(JSON.parse(given)) : value));
}"""


class Firefox:
    """A browser and its one page."""

    def __init__(self, loop: asyncio.AbstractEventLoop, address: str) -> None:
        self.run = loop.run_until_complete
        self.socket = self.run(websocket_connect(address, max_message_size=1 << 28))
        self.listeners: dict[str, Callable[[Any], None]] = {}
        self.number = 0
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=list(EVENTS))
        self.context = self.call("browsingContext.getTree")["contexts"][0]["context"]

    def call(self, method: str, **parameters: Any) -> Any:
        """Return the result of a command, and pass on the events before it."""
        self.number += 1
        command = {"id": self.number, "method": method, "params": parameters}
        self.run(self.socket.write_message(json.dumps(command)))
        while "id" not in (answer := json.loads(self.run(self.socket.read_message()))):
            event = answer["params"]
            told = SimpleNamespace(text=event.get("text"), url=event.get("request", {}).get("url"))
            self.listeners[EVENTS[answer["method"]]](told)
        assert answer["type"] == "success", answer
        return answer["result"]

    def new_page(self, viewport: dict[str, int]) -> Firefox:
        self.call("browsingContext.setViewport", context=self.context, viewport=viewport)
        return self

    def on(self, event: str, listener: Callable[[Any], None]) -> None:
        self.listeners[event] = listener

    def goto(self, url: str) -> None:
        self.call("browsingContext.navigate", context=self.context, url=url, wait="complete")

    def evaluate(self, script: str, argument: Any = None) -> Any:
        """Return the value of an expression, or of a function of one argument."""
        answer = self.call(
            "script.callFunction",
            functionDeclaration=_EVALUATE.replace("SCRIPT", script),
            arguments=[{"type": "string", "value": json.dumps(argument)}],
            target={"context": self.context},
            awaitPromise=True,
        )
        assert answer["type"] == "success", answer["exceptionDetails"]["text"]
        return json.loads(answer["result"].get("value", "null"))

    def close(self) -> None:
        """Keep the page: the next one comes in its place."""


@contextlib.contextmanager
def firefox() -> Iterator[Firefox]:
    program = shutil.which("firefox-esr") or "firefox"
    with tempfile.TemporaryDirectory() as profile, asyncio.Runner() as runner:
        Path(profile, "user.js").write_text('user_pref("webgl.force-enabled", true);\n')
        said = Path(profile, "WebDriverBiDiServer.json")
        command = [program, "--remote-debugging-port", "0", "--profile", profile, "about:blank"]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        with subprocess.Popen(command, **quiet) as process:
            try:
                while not (said.exists() and said.read_text()):
                    assert process.poll() is None, "Firefox needs a display"
                    time.sleep(0.1)
                port = json.loads(said.read_text())["ws_port"]
                yield Firefox(runner.get_loop(), f"ws://127.0.0.1:{port}/session")
            finally:
                process.terminate()
