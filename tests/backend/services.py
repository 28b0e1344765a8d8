"""Private PostgreSQL and Redis servers, from Debian's packages, that end with the test."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

PROGRAMS = sorted(Path("/usr/lib/postgresql").glob("*/bin"))
TIMEOUT_S = 60


def _program(name):
    found = shutil.which(name) or next(
        (str(p / name) for p in reversed(PROGRAMS) if (p / name).exists()), None
    )
    assert found, f"{name} is missing: apt install postgresql redis-server"
    return found


@contextmanager
def postgresql(place=None, **settings):
    """The URL of a fresh cluster in `place`, on a Unix socket alone; PostgreSQL refuses to run as root."""
    as_user = {"user": "postgres", "group": "postgres", "extra_groups": []} if os.geteuid() == 0 else {}
    with tempfile.TemporaryDirectory(prefix="bts-pg-", dir=place) as name:
        folder = Path(name)
        if as_user:
            shutil.chown(folder, "postgres", "postgres")
        data = folder / "data"
        quick = ["--no-sync", "--no-instructions", "--auth=trust", "--username=bts", "--encoding=UTF8"]
        initdb = [_program("initdb"), "--locale=C.UTF-8", *quick, "-D", data]
        subprocess.run(initdb, check=True, stdout=subprocess.DEVNULL, cwd=folder, **as_user)
        options = {"listen_addresses": "", "unix_socket_directories": name, "max_connections": 60} | settings
        arguments = [part for key, value in options.items() for part in ("-c", f"{key}={value}")]
        log = (folder / "log").open("wb")
        process = subprocess.Popen(
            [_program("postgres"), "-D", data, *arguments], stdout=log, stderr=log, cwd=folder, **as_user
        )
        try:
            _await(lambda: _answers([_program("pg_isready"), "-q", "-h", name, "-U", "bts"]), process)
            subprocess.run([_program("createdb"), "-h", name, "-U", "bts", "bts"], check=True, cwd=folder)
            yield f"postgresql://bts@/bts?host={name}"
        finally:
            process.terminate()  # "smart": waits for clients; the second signal does not
            time.sleep(0.1)
            process.send_signal(2)
            process.wait(timeout=TIMEOUT_S)
            log.close()


@contextmanager
def redis():
    """The URL of an empty Redis, on a Unix socket alone."""
    with tempfile.TemporaryDirectory(prefix="bts-redis-") as name:
        socket = f"{name}/redis.sock"
        command = [
            _program("redis-server"),
            "--port",
            "0",
            "--unixsocket",
            socket,
            "--save",
            "",
            "--dir",
            name,
        ]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        try:
            _await(lambda: _answers([_program("redis-cli"), "-s", socket, "ping"]), process)
            yield f"unix://{socket}?db=0"
        finally:
            process.terminate()
            process.wait(timeout=TIMEOUT_S)


def _answers(command):
    return subprocess.run(command, check=False, capture_output=True).returncode == 0


def _await(is_ready, process):
    deadline = time.monotonic() + TIMEOUT_S
    while not is_ready():
        assert process.poll() is None, "the service ended by itself"
        assert time.monotonic() < deadline
        time.sleep(0.05)
