"""The language server as an editor starts it, with an editor's messages."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

FILE = "coordinates: [x]\nparameters: [m]\nT: m*x'^2/2\nV: m*y  # \U0001d6fc\n"


class Editor:
    """Sends and receives messages of the protocol."""

    def __init__(self, process):
        self.process, self.count = process, 0

    def send(self, method, **params):
        self._write({"method": method, "params": params})

    def ask(self, method, **params):
        self.count += 1
        self._write({"id": self.count, "method": method, "params": params})
        return self.receive(lambda message: message.get("id") == self.count)["result"]

    def _write(self, message):
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
        self.process.stdin.flush()

    def receive(self, wanted):
        while True:
            length = 0
            while (line := self.process.stdout.readline().strip()) != b"":
                if line.lower().startswith(b"content-length:"):
                    length = int(line.partition(b":")[2])
            assert length, "the server has ended"
            message = json.loads(self.process.stdout.read(length))
            if wanted(message):
                return message


@pytest.fixture
def editor():
    process = subprocess.Popen(
        [sys.executable, "-m", "lagcli.lsp"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    made = Editor(process)
    made.ask("initialize", processId=None, rootUri=None, capabilities={})
    made.send("initialized")
    yield made
    made.ask("shutdown")
    made.send("exit")
    process.stdin.close()
    assert process.wait() == 0
    process.stdout.close()


def test_an_editor_gets_mistakes_completions_and_formulas(editor):
    uri = "file:///spring.yaml"
    document = {"uri": uri, "languageId": "yaml", "version": 1, "text": FILE}
    editor.send("textDocument/didOpen", textDocument=document)
    (found,) = editor.receive(lambda m: "diagnostics" in m.get("params", {}))["params"][
        "diagnostics"
    ]
    assert "unknown name 'y' in V" in found["message"]
    assert found["range"] == {
        "start": {"line": 3, "character": 5}, "end": {"line": 3, "character": 6},
    }  # fmt: skip
    place = {"textDocument": {"uri": uri}, "position": {"line": 3, "character": 3}}
    offered = editor.ask("textDocument/completion", **place)
    assert {"x", "x'", "m", "cos"} <= {each["label"] for each in offered}
    place["position"]["line"] = 2
    shown = editor.ask("textDocument/hover", **place)
    assert shown["contents"]["value"].startswith("```\nm ẋ²/2\n```")
    change = {
        "textDocument": {"uri": uri, "version": 2},
        "contentChanges": [{"text": FILE.replace("y", "x", 1).replace("m*y", "m*x")}],
    }
    editor.send("textDocument/didChange", **change)
    later = editor.receive(lambda m: "diagnostics" in m.get("params", {}))
    assert later["params"]["diagnostics"] == []


def test_a_file_that_is_closed_has_no_mistakes_left(editor):
    document = {"uri": "file:///a.yaml", "languageId": "yaml", "version": 1, "text": FILE}
    editor.send("textDocument/didOpen", textDocument=document)
    editor.receive(lambda m: m.get("params", {}).get("diagnostics"))
    editor.send("textDocument/didClose", textDocument={"uri": "file:///a.yaml"})
    assert editor.receive(lambda m: m.get("params", {}).get("diagnostics") == [])


def test_without_pygls_it_says_what_to_install(monkeypatch, capsys):
    from lagcli.lsp.__main__ import main

    monkeypatch.setitem(sys.modules, "lsprotocol", None)
    assert main() == 2
    assert "pip install 'lagcli[lsp]'" in capsys.readouterr().err
