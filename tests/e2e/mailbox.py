"""A mail server that stores its messages, for tests that read users' mail."""

from __future__ import annotations

import re
import socketserver
import threading
from contextlib import contextmanager
from email import message_from_bytes, policy
from typing import TYPE_CHECKING

from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator
    from email.message import EmailMessage


class _Delivery(socketserver.StreamRequestHandler):
    """The part of RFC 5321 that Python's client uses."""

    def handle(self) -> None:
        self._say("220 mailbox")
        while line := self.rfile.readline():
            command = line[:4].upper().strip()
            if command == b"DATA":
                self._say("354 continue")
                self._keep()
            self._say("221 bye" if command == b"QUIT" else "250 ok")
            if command == b"QUIT":
                return

    def _keep(self) -> None:
        lines = list(iter(self.rfile.readline, b".\r\n"))
        raw = b"".join(line[1:] if line.startswith(b"..") else line for line in lines)
        mail: EmailMessage = message_from_bytes(raw, policy=policy.default)
        self.server.mails.append(mail)  # type: ignore[attr-defined]

    def _say(self, line: str) -> None:
        self.wfile.write(f"{line}\r\n".encode())


class Mailbox(socketserver.ThreadingTCPServer):
    """All mail that was sent, to any recipient."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Delivery)
        self.mails: list[EmailMessage] = []

    @property
    def url(self) -> str:
        """The value of `BT_STUDIO_SMTP_URL`."""
        return f"smtp://127.0.0.1:{self.server_address[1]}"

    def link_for(self, address: str) -> str:
        """Waits for the newest mail to someone, removes it, and returns its link."""
        wait_until(lambda: any(mail["To"] == address for mail in self.mails), f"{address} gets a mail")
        mail = next(mail for mail in reversed(self.mails) if mail["To"] == address)
        self.mails.remove(mail)
        body = mail.get_body(("plain",))
        assert body is not None
        found = re.search(r"http://\S+", body.get_content())
        assert found, body.get_content()
        return found[0]


@contextmanager
def mailbox() -> Iterator[Mailbox]:
    """Runs a mail server on a free port."""
    with Mailbox() as box:
        thread = threading.Thread(target=box.serve_forever, kwargs={"poll_interval": 0.05})
        thread.start()
        try:
            yield box
        finally:
            box.shutdown()
            thread.join()
