"""A manager that gives a recording as the real one does, or with one fault."""

from __future__ import annotations

import contextlib
import re
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

TOKEN = "t0ken"


@contextlib.contextmanager
def recordings(
    data: bytes, *, part: int = 100_000, fault: str = "", token: str = TOKEN, run: str = "a1"
) -> Iterator[str]:
    """Gives `data` as a run, in parts; yields the address.

    Faults: `changes` (another ETag for each part), `grows` (another ETag once), `cut` (a part ends early),
    `skips` (another part than was asked for), `huge` (claims 1 TB), `hangs_up`, `conflict`.
    """

    class Manager(BaseHTTPRequestHandler):
        parts = 0

        def do_GET(self) -> None:
            if self.headers["Authorization"] != f"Bearer {token}" or self.path != f"/recordings/{run}/0":
                self.send_error(404)
                return
            if fault == "hangs_up":
                self.connection.close()
                return
            if fault == "conflict":
                self.send_error(409)
                return
            named = re.fullmatch(r"bytes=(\d+)-", self.headers["Range"])
            assert named
            begin = int(named[1]) + (1 if fault == "skips" else 0)
            body = data[begin : begin + part]
            total = 10**12 if fault == "huge" else len(data)
            Manager.parts += 1
            self.send_response(206)
            self.send_header("Content-Range", f"bytes {begin}-{begin + len(body) - 1}/{total}")
            self.send_header("ETag", f'"{Manager.tag()}"')
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body[:-1] if fault == "cut" else body)

        @classmethod
        def tag(cls) -> int:
            return cls.parts if fault == "changes" else int(fault == "grows" and cls.parts > 2)

        def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - its name there
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Manager)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()
