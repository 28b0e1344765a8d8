"""A client of the Debug Adapter Protocol, written from its specification; it starts the adapter itself."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import queue
import subprocess
import sys
import threading
from pathlib import Path
from typing import IO, Any, Self

ROOT = Path(__file__).parents[4]
DEADLINE_S = 200.0


ADAPTER = (sys.executable, "-m", "backend.cli.main", "dap")


class DapClient:
    """Starts `bt-studio dap`, and ends it at the end of the block."""

    def __init__(self, *through: str) -> None:
        """Starts the adapter, through another command if there is one."""
        self.process = subprocess.Popen(
            [*through, *ADAPTER],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            cwd=ROOT,
            env={**os.environ, "PYTHONHASHSEED": "0"},
        )
        self.events: list[dict[str, Any]] = []
        self.printed = ""
        self._seq = itertools.count(1)
        self._come: queue.Queue[dict[str, Any] | None] = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self._reader.join()
        with contextlib.suppress(BrokenPipeError):
            self.stdin.close()
        if self.process.stdout is not None:
            self.process.stdout.close()
        self.process.wait()

    @property
    def stdin(self) -> IO[bytes]:
        assert self.process.stdin is not None
        return self.process.stdin

    def send(self, command: str, **arguments: Any) -> int:
        seq = next(self._seq)
        self.write({"seq": seq, "type": "request", "command": command, "arguments": arguments})
        return seq

    def write(self, message: Any) -> None:
        text = json.dumps(message).encode()
        self.stdin.write(f"Content-Length: {len(text)}\r\n\r\n".encode() + text)
        self.stdin.flush()

    def answer(self, seq: int) -> dict[str, Any]:
        while True:
            message = self._next()
            if message["type"] == "response" and message["request_seq"] == seq:
                return message

    def ask(self, command: str, **arguments: Any) -> dict[str, Any]:
        """Returns the body of the answer to a request that is done."""
        answer = self.answer(self.send(command, **arguments))
        assert answer["success"], answer
        body: dict[str, Any] = answer["body"]
        return body

    def refused(self, command: str, **arguments: Any) -> str:
        answer = self.answer(self.send(command, **arguments))
        assert not answer["success"], answer
        return str(answer["message"])

    def event(self, name: str) -> dict[str, Any]:
        """Returns the body of the next event of a name."""
        while True:
            for index, message in enumerate(self.events):
                if message["event"] == name:
                    del self.events[: index + 1]
                    body: dict[str, Any] = message["body"]
                    return body
            self._next()

    def launch(self, **arguments: Any) -> None:
        self.ask("initialize", adapterID="bt-studio", linesStartAt1=True)
        self.ask("launch", **arguments)
        self.event("initialized")

    def _next(self) -> dict[str, Any]:
        message = self._come.get(timeout=DEADLINE_S)
        assert message is not None, "the adapter has ended"
        if message["type"] == "event" and message["event"] == "output":
            self.printed += message["body"]["output"]
        elif message["type"] == "event":
            self.events.append(message)
        return message

    def _read(self) -> None:
        out = self.process.stdout
        assert out is not None
        while line := out.readline():
            assert line.startswith(b"Content-Length: "), line
            assert out.readline() == b"\r\n"
            self._come.put(json.loads(out.read(int(line.split(b":")[1]))))
        self._come.put(None)
