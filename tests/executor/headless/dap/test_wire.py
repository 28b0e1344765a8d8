"""Requests are read, and others dropped; answers and events have increasing numbers."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from typing import Any

from executor.debug_adapter.framing import framed, read_framed
from executor.headless.dap.wire import GONE, Request, Wire

PROGRAM = """
import os, sys
from executor.headless.dap.wire import own_streams
with own_streams() as wire:
    print("printed")
    os.system("echo of a child")
    sys.stderr.write("an error\\n")
    wire.respond(wire.requests.get(), {"read": sys.stdin.read()})
print("again on the stream")
"""


def sent(data: bytes) -> list[dict[str, Any]]:
    source = io.BytesIO(data)
    return [json.loads(text) for text in iter(lambda: read_framed(source), None)]


def test_requests_are_read_until_the_end_and_the_rest_is_dropped() -> None:
    wrong = [b"{", b"[]", b"3", b"[" * 10000, b'{"type":"event"}', b'{"type":"request","seq":true}']
    good = {"type": "request", "seq": 4, "command": "scopes", "arguments": {"frameId": 3, "x": True}}
    data = b"".join(framed(each) for each in [*wrong, json.dumps(good).encode()])
    wire = Wire(io.BytesIO(data + b"Content-Length: x\r\n\r\n"), io.BytesIO())
    request = wire.requests.get(timeout=30)
    assert (request.command, request.number("frameId"), request.number("x"), request.text("frameId")) == (
        "scopes",
        3,
        0,
        "",
    )
    assert wire.requests.get(timeout=30).command == GONE


def test_answers_and_events_are_numbered() -> None:
    sink = io.BytesIO()
    wire = Wire(io.BytesIO(), sink)
    wire.respond(Request(7, "threads"), {"threads": []})
    wire.refuse(Request(8, "pause"), "not now")
    wire.say("a line")
    found = sent(sink.getvalue())
    assert [each["seq"] for each in found] == [1, 2, 3]
    assert [each.get("request_seq") for each in found] == [7, 8, None]
    assert (found[1]["success"], found[1]["message"]) == (False, "not now")
    assert found[2]["body"] == {"category": "console", "output": "a line\n"}
    sink.close()
    wire.say("nobody reads it")


def test_what_the_process_prints_becomes_output() -> None:
    text = json.dumps({"type": "request", "seq": 1, "command": "x"}).encode()
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=framed(text),
        capture_output=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.getcwd()},  # noqa: PTH109 - as the shell would give it
    )
    begin, _, rest = done.stdout.partition(b"again on the stream\n")
    assert rest == b""
    found = sent(begin)
    lines = {each["body"]["output"] for each in found if each["type"] == "event"}
    assert lines == {"printed\n", "of a child\n", "an error\n"}
    [answer] = [each for each in found if each["type"] == "response"]
    assert answer["body"] == {"read": ""}, "the requests are not the input of the program"
