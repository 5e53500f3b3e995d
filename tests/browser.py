"""Chromium without a window, driven through two pipes: what a page logs, asks for and shows.

The protocol is that of Chrome's developer tools: messages of JSON, each ended by a zero byte.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

PROGRAM = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
_OPTIONS = ("--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe", "about:blank")


_PHONE = {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True}


class Browser:
    """One page, as wide as a phone, which goes from address to address."""

    def __enter__(self):
        command_read, self._commands = os.pipe()
        self._answers, answer_write = os.pipe()
        # the program reads from 3 and writes to 4, whatever stands there before
        script = f'exec "$@" 3<&{command_read} 4>&{answer_write}'
        self._process = subprocess.Popen(
            ["bash", "-c", script, "bash", PROGRAM, *_OPTIONS],
            pass_fds=(command_read, answer_write),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(command_read)
        os.close(answer_write)
        self._buffer, self._count, self._session, self._events = b"", 0, None, []
        targets = self.call("Target.getTargets")["targetInfos"]
        page = next(each["targetId"] for each in targets if each["type"] == "page")
        found = self.call("Target.attachToTarget", targetId=page, flatten=True)
        self._session = found["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", **_PHONE)
        return self

    def __exit__(self, *_):
        self._process.terminate()
        self._process.wait()
        os.close(self._commands)
        os.close(self._answers)

    def _receive(self):
        while b"\0" not in self._buffer:
            data = os.read(self._answers, 1 << 16)
            assert data, "the browser has ended"
            self._buffer += data
        message, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        """The result of a method of the protocol."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        while (answer := self._receive()).get("id") != self._count:
            self._events.append(answer)
        return answer["result"]

    def run(self, script):
        """The value of a line of JavaScript, or of what it promises."""
        found = self.call(
            "Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True
        )
        return found["result"].get("value")

    def pixels_too_wide(self):
        """How far the page can be pushed to the left."""
        page = "document.documentElement"
        return self.run(f"{page}.scrollWidth - {page}.clientWidth")

    def complaints(self, page: Path):
        """Errors, warnings, and requests that lead out of a page, once it is shown."""
        self._events = []
        address = page.as_uri()
        self.call("Page.navigate", url=address)
        while not any(each.get("method") == "Page.loadEventFired" for each in self._events):
            self._events.append(self._receive())
        self.run("new Promise((done) => setTimeout(done, 100))")
        return [said for each in self._events if (said := _complaint(each, address))]


def _complaint(event, address):
    given = event.get("params", {})
    match event.get("method"):
        case "Runtime.exceptionThrown":
            return str(given["exceptionDetails"])
        case "Runtime.consoleAPICalled" if given["type"] in ("error", "warning"):
            return str(given["args"])
        case "Log.entryAdded" if given["entry"]["level"] in ("error", "warning"):
            return given["entry"]["text"]
        case "Network.requestWillBeSent":
            asked = given["request"]["url"]
            return "" if asked == address or asked.startswith(("data:", "about:")) else asked
    return ""
