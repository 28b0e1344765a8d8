"""Messages that pass between a page and its language server."""

from __future__ import annotations

import pytest

from backend.language.protocol.messages import for_page, for_server

ROOT = "file:///files"


def test_the_page_decides_neither_folders_nor_interpreters():
    wish = {
        "rootUri": "file:///etc",
        "processId": 1,
        "initializationOptions": {"pythonPath": "/evil/python"},
        "capabilities": {"workspace": {"configuration": True}, "textDocument": {"hover": {}}},
    }
    passed, answer = for_server({"id": 1, "method": "initialize", "params": wish}, ROOT)
    assert answer is None
    assert passed["params"] == {
        "processId": None,
        "clientInfo": {"name": "bt-studio"},
        "rootUri": ROOT,
        "workspaceFolders": [{"uri": ROOT, "name": "project"}],
        "capabilities": {"textDocument": {"hover": {}}},
    }


@pytest.mark.parametrize("method", ["workspace/executeCommand", "workspace/didChangeConfiguration", 7])
def test_what_no_editor_needs_is_answered_and_not_passed_on(method):
    passed, answer = for_server({"id": 4, "method": method}, ROOT)
    assert passed is None
    assert answer["id"] == 4
    assert answer["error"]["code"] == -32601


def test_a_message_that_is_no_object_is_refused():
    assert for_server([1], ROOT)[1]["error"]["code"] == -32600


def test_requests_of_the_server_are_answered_here():
    request = {"id": 9, "method": "workspace/configuration", "params": {}}
    assert for_page(request) == (None, {"jsonrpc": "2.0", "id": 9, "result": None})


def test_the_user_reads_no_places_of_this_machine():
    hover = "```python\n(class) Twist\n```\n---\nSee [node](file:///x/node.py)."
    shown, _ = for_page({"id": 1, "result": {"contents": {"kind": "markdown", "value": hover}}})
    assert shown["result"]["contents"]["value"] == "```python\n(class) Twist\n```\n---\nSee node."
    finding = {"message": "Cannot find module `x`\n\ninfo: Searched in the following paths:\ninfo: 1. /data"}
    shown, _ = for_page(
        {"method": "textDocument/publishDiagnostics", "params": {"uri": "u", "diagnostics": [finding]}}
    )
    assert shown["params"]["diagnostics"][0]["message"] == "Cannot find module `x`"


def test_hints_are_no_findings():
    found = [{"message": "wrong", "severity": 1}, {"message": "unused argument", "severity": 4}]
    message = {"method": "textDocument/publishDiagnostics", "params": {"uri": "u", "diagnostics": found}}
    told, _ = for_page(message)
    assert [each["message"] for each in told["params"]["diagnostics"]] == ["wrong"]


def test_a_class_is_named_as_python_names_it():
    message = {"id": 1, "result": {"contents": {"value": "```xml\n<class 'Turn'>\n```\n---\nTurns."}}}
    told, _ = for_page(message)
    assert told["result"]["contents"]["value"] == "```python\nclass Turn\n```\n---\nTurns."
