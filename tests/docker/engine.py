"""A Docker engine for the tests: the running one, or a separate one that is started as root."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

REPOSITORY = Path(__file__).parents[2]
DATA = REPOSITORY / "var" / "docker"
SOCKET = Path("/var/run/docker.sock")
PACKAGES = ("docker.io", "docker-compose", "debootstrap", "iptables", "shellcheck")
# Debian's program first: another program named docker may be a different client.
CANDIDATES = ("/usr/bin/docker", "docker")
DEADLINE_S = 120


class Engine(NamedTuple):
    """A running engine: its socket, and the programs that talk to it."""

    socket: Path
    docker: str
    compose: tuple[str, ...]

    @property
    def environment(self) -> dict[str, str]:
        """Returns the environment in which the programs use this engine."""
        return {**os.environ, "DOCKER_HOST": f"unix://{self.socket}", "DOCKER": self.docker}

    def run(self, *arguments: str, check: bool = True, **options: object) -> subprocess.CompletedProcess[str]:
        """Runs `docker`."""
        return _run((self.docker, *arguments), self.environment, check=check, **options)


def _run(command, environment, *, check=True, **options):
    done = subprocess.run(
        command, env=environment, check=False, text=True, capture_output=True, cwd=REPOSITORY, **options
    )
    assert not check or done.returncode == 0, f"{' '.join(command)}\n{done.stdout}\n{done.stderr}"
    return done


def why_not() -> str:
    """Returns why no engine is available; empty if one is."""
    if os.geteuid() != 0:
        return "it takes root to start a Docker engine"
    if shutil.which("apt-get") is None and not _has_programs():
        return "Docker is missing, and this is no Debian to install it from"
    return ""


def _has_programs() -> bool:
    return all(shutil.which(name) for name in ("dockerd", "docker-compose", "debootstrap", "shellcheck"))


@contextmanager
def engine(folder: Path) -> Iterator[Engine]:
    """Yields this machine's engine, or a new one until the end; its images are stored in `var/docker`."""
    if not _has_programs():
        install = ["apt-get", "install", "-y", "-q", "--no-install-recommends", *PACKAGES]
        quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
        _run(["apt-get", "update", "-q"], quiet)
        _run(install, quiet)
    if SOCKET.exists() and _engine(SOCKET).run("info", check=False).returncode == 0:
        yield _engine(SOCKET)
        return
    DATA.mkdir(parents=True, exist_ok=True)
    with new_engine(folder, "docker", DATA) as ours:
        yield ours


@contextmanager
def new_engine(folder: Path, name: str, data: Path, *options: str) -> Iterator[Engine]:
    """Starts an engine of its own, and ends it at the end.

    Args:
        folder: where its socket and its log are.
        name: the name of these.
        data: where its images and containers are stored.
        options: further options of `dockerd`.
    """
    ours = _engine(folder / f"{name}.sock")
    command = ["dockerd", "--data-root", str(data), "--exec-root", str(folder / f"{name}.exec")]
    command += ["--host", f"unix://{ours.socket}", "--pidfile", str(folder / f"{name}.pid"), *options]
    log_file = folder / f"{name}d.log"
    with log_file.open("wb") as log:
        daemon = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
    try:
        deadline = time.monotonic() + DEADLINE_S
        while ours.run("info", check=False).returncode:
            assert daemon.poll() is None, log_file.read_text()[-4000:]
            assert time.monotonic() < deadline, "dockerd does not answer"
            time.sleep(0.2)
        yield ours
    finally:
        daemon.send_signal(signal.SIGTERM)
        daemon.wait(DEADLINE_S)


def _engine(socket: Path) -> Engine:
    docker = next(name for name in CANDIDATES if shutil.which(name))
    plugin = subprocess.run([docker, "compose", "version"], capture_output=True, check=False).returncode == 0
    return Engine(socket, docker, (docker, "compose") if plugin else ("docker-compose",))


def build_images(engine: Engine, tag: str) -> None:
    """Builds the images as a user does, with this machine's CA bundle as a build secret."""
    bundle = os.environ.get("SSL_CERT_FILE") or "/etc/ssl/certs/ca-certificates.crt"
    given = {"BT_STUDIO_CA": bundle} if Path(bundle).is_file() else {}
    _run(["bash", "docker/images.sh", tag], engine.environment | given)
