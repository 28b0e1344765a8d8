"""A relay in its own process, before a folder with sockets, and web servers that call it."""

from __future__ import annotations

import socket
import subprocess
import sys
import tempfile
import threading
from contextlib import ExitStack, suppress
from pathlib import Path

import pytest

from backend.sessions.hosts.authority import host_bundle, renew_web_bundle
from backend.sessions.relay.hello import KEEPER, socket_of, write_hello
from backend.sessions.relay.tls import client_context
from tests.backend.services import free_port
from tests.e2e.server import wait_until

ROOT = Path(__file__).parents[4]
HOST = "127.0.0.1"


class Echo:
    """A unix socket that sends back what it receives, after its name."""

    def __init__(self, path, name):
        path.parent.mkdir(exist_ok=True)
        self._listener = socket.socket(socket.AF_UNIX)
        self._listener.bind(str(path))
        self._listener.listen()
        self._name = name
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while True:
            try:
                connection, _ = self._listener.accept()
            except OSError:
                return
            threading.Thread(target=self._answer, args=(connection,), daemon=True).start()

    def _answer(self, connection):
        with connection, suppress(OSError):
            connection.sendall(self._name.encode() + b":")
            while data := connection.recv(65536):
                if data == b"bye":
                    return
                connection.sendall(data)

    def close(self):
        self._listener.close()


class RelayProcess:
    """The program, and the certificates of both ends."""

    def __init__(self, folder):
        self.folder = folder
        self.authority = folder / "authority"
        self.web = renew_web_bundle(self.authority)
        self.bundle = folder / "host.pem"
        self.bundle.write_text(host_bundle(self.authority, HOST))
        self.port = free_port()
        self._kept = ExitStack()
        self.sockets = folder / "keeper"
        self.sockets.mkdir()
        self.process = None

    def open_socket(self, what):
        echo = Echo(self.sockets / socket_of(what), what)
        self._kept.callback(echo.close)

    def program(self, *arguments, **options):
        command = [sys.executable, "-m", "backend.sessions.relay", *arguments]
        environment = {
            "BT_STUDIO_RELAY_BUNDLE": str(self.bundle),
            "BT_STUDIO_RELAY_HOST": HOST,
            "BT_STUDIO_RELAY_PORT": str(self.port),
            "BT_STUDIO_KEEPER_FOLDER": str(self.sockets),
        }
        return command, {"env": environment, "cwd": ROOT, **options}

    def start(self):
        command, options = self.program()
        self.log = self._kept.enter_context((self.folder / "log").open("wb"))
        self.process = subprocess.Popen(command, **options, stderr=self.log)
        wait_until(self.listens, "the relay listens")

    def listens(self):
        assert self.process.poll() is None, (self.folder / "log").read_text()
        with socket.socket() as probe:
            return probe.connect_ex((HOST, self.port)) == 0

    def plain(self):
        return socket.create_connection((HOST, self.port), 60)

    def secure(self, context=None, name=HOST):
        return (context or client_context(self.web)).wrap_socket(self.plain(), server_hostname=name)

    def join(self, what=KEEPER, **options):
        stream = self.secure(**options)
        stream.sendall(write_hello(what))
        return stream

    def close(self):
        if self.process is not None:
            self.process.terminate()
            self.process.wait(60)
        self._kept.close()


@pytest.fixture
def relay():
    with tempfile.TemporaryDirectory() as made:
        process = RelayProcess(Path(made))
        yield process
        process.close()


def receive(stream, number):
    data = b""
    while len(data) < number:
        more = stream.recv(number - len(data))
        assert more, f"closed after {data!r}"
        data += more
    return data
