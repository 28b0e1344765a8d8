"""Private PostgreSQL and Redis servers, from Debian's packages, that end with the test."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Any

PROGRAMS = sorted(Path("/usr/lib/postgresql").glob("*/bin"))
TIMEOUT_S = 60


def free_port() -> int:
    """Returns an unused port of this machine."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _program(name):
    found = shutil.which(name) or next(
        (str(p / name) for p in reversed(PROGRAMS) if (p / name).exists()), None
    )
    assert found, f"{name} is missing: apt install postgresql redis-server"
    return found


class Cluster:
    """A PostgreSQL server, on a Unix socket alone."""

    def __init__(self, folder, command, options):
        self.url = f"postgresql://bts@/bts?host={folder}"
        self._folder, self._command, self._options = folder, command, options
        self._log = (folder / "log").open("wb")
        self._process = None
        self.start()

    def start(self):
        """Starts the server, unless it runs, and waits until it answers; also if it is about to end."""
        ready = [_program("pg_isready"), "-q", "-h", self._folder, "-U", "bts"]
        deadline = time.monotonic() + TIMEOUT_S
        while not self._runs() or not _answers(ready):
            assert time.monotonic() < deadline, self.said()[-2000:]
            if not self._runs():
                self._process = subprocess.Popen(
                    self._command, stdout=self._log, stderr=self._log, cwd=self._folder, **self._options
                )
            time.sleep(0.05)

    def _runs(self):
        return self._process is not None and self._process.poll() is None

    def said(self):
        """Returns the server's log."""
        return (self._folder / "log").read_text()

    def crash(self):
        """Ends the server at once, without a checkpoint: its next start recovers from its log."""
        self._process.send_signal(signal.SIGQUIT)
        self._process.wait(timeout=TIMEOUT_S)

    def end(self):
        self._process.terminate()  # "smart": waits for clients; the second signal does not
        time.sleep(0.1)
        self._process.send_signal(2)
        self._process.wait(timeout=TIMEOUT_S)
        self._log.close()


@contextmanager
def cluster(place=None, *, data=None, log=None, segment_mb=16, **settings):
    """A fresh server in `place`; its data and its write-ahead log may be elsewhere."""
    # PostgreSQL refuses to run as root.
    as_user: dict[str, Any] = (
        {"user": "postgres", "group": "postgres", "extra_groups": []} if os.geteuid() == 0 else {}
    )
    with tempfile.TemporaryDirectory(prefix="bts-pg-", dir=place) as name:
        folder = Path(name)
        data = data or folder / "data"
        if log:
            log.mkdir()
        for one in {folder, data.parent, log or folder} if as_user else ():
            shutil.chown(one, "postgres", "postgres")
        quick = ["--no-sync", "--no-instructions", "--auth=trust", "--username=bts", "--encoding=UTF8"]
        quick += ["--locale=C.UTF-8", f"--wal-segsize={segment_mb}", *([f"--waldir={log}"] if log else [])]
        initdb = [_program("initdb"), *quick, "-D", data]
        subprocess.run(initdb, check=True, stdout=subprocess.DEVNULL, cwd=folder, **as_user)
        options = {"listen_addresses": "", "unix_socket_directories": name, "max_connections": 60} | settings
        arguments = [part for key, value in options.items() for part in ("-c", f"{key}={value}")]
        running = Cluster(folder, [_program("postgres"), "-D", data, *arguments], as_user)
        try:
            subprocess.run([_program("createdb"), "-h", name, "-U", "bts", "bts"], check=True, cwd=folder)
            yield running
        finally:
            running.end()


@contextmanager
def postgresql(place=None, **settings):
    """The URL of a fresh server."""
    with cluster(place, **settings) as running:
        yield running.url


class Redis:
    """A Redis server that stores nothing on disk, on a Unix socket alone."""

    def __init__(self, folder):
        self._socket = f"{folder}/redis.sock"
        self.url = f"unix://{self._socket}?db=0"
        self._command = [_program("redis-server"), "--port", "0", "--unixsocket", self._socket]
        self._command += ["--save", "", "--dir", folder]
        self.start()

    def start(self):
        """Starts an empty server, and waits until it answers."""
        self._process = subprocess.Popen(self._command, stdout=subprocess.DEVNULL)
        ping = [_program("redis-cli"), "-s", self._socket, "ping"]
        await_service(lambda: _answers(ping), self._process)

    def end(self, how=signal.SIGTERM):
        self._process.send_signal(how)
        self._process.wait(timeout=TIMEOUT_S)


@contextmanager
def redis_server():
    """An empty Redis."""
    with tempfile.TemporaryDirectory(prefix="bts-redis-") as name:
        running = Redis(name)
        try:
            yield running
        finally:
            running.end()


@contextmanager
def redis():
    """The URL of an empty Redis."""
    with redis_server() as running:
        yield running.url


def _answers(command):
    return subprocess.run(command, check=False, capture_output=True).returncode == 0


def await_service(is_ready, process):
    deadline = time.monotonic() + TIMEOUT_S
    while not is_ready():
        assert process.poll() is None, "the service ended by itself"
        assert time.monotonic() < deadline
        time.sleep(0.05)
