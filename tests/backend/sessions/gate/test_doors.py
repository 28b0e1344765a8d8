"""Doors of sessions."""

from __future__ import annotations

import socket
import tempfile
from pathlib import Path

from backend.sessions.gate.doors import listen_at


def test_a_socket_is_made_with_its_rights_and_replaces_what_was_left():
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "s"
        for _ in range(2):
            listener = listen_at(path, 0o600)
            assert path.stat().st_mode & 0o777 == 0o600
            with socket.socket(socket.AF_UNIX) as caller:
                caller.connect(str(path))
            listener.close()
