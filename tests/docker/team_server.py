"""The team's server as `docker/up.sh` starts it: behind Caddy, by https."""

from __future__ import annotations

import os
import re
import secrets
import socket
import ssl
from typing import TYPE_CHECKING

from tests.docker.engine import REPOSITORY, _run
from tests.docker.stack import COMPOSE, Stack, User

if TYPE_CHECKING:
    import subprocess
    from collections.abc import Mapping
    from pathlib import Path

    from tests.docker.engine import Engine

UP = REPOSITORY / "docker" / "up.sh"
LINK = re.compile(r"https://\S+/accounts/password/reset/key/\S+")


def free_ports(count: int) -> list[int]:
    """Returns unused ports of loopback."""
    probes = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [int(probe.getsockname()[1]) for probe in probes]
    for probe in probes:
        probe.close()
    return ports


class TeamServer(Stack):
    """A stack with the settings of `docker/up.sh`, in a folder of its own."""

    files = (COMPOSE,)

    def __init__(self, engine: Engine, folder: Path, tag: str, name: str = "") -> None:
        self.engine = engine
        self.name = name or "btteam" + secrets.token_hex(3)
        self.folder = folder
        self.http_port, self.port = free_ports(2)
        self.base = f"https://localhost:{self.port}"
        self._tag = tag
        self._file = folder / ".env"

    def up_sh(
        self, *options: str, check: bool = True, extra: Mapping[str, str] | None = None
    ) -> subprocess.CompletedProcess[str]:
        """Runs `docker/up.sh localhost` with the existing images; returns its output."""
        command = [str(UP), "localhost", "--no-build", *self._ports, *options]
        return _run(command, self.environment | dict(extra or {}), check=check)

    @property
    def _ports(self) -> tuple[str, ...]:
        return ("--http-port", str(self.http_port), "--https-port", str(self.port))

    @property
    def environment(self) -> dict[str, str]:
        """Returns the environment of the scripts of `docker/`."""
        ours = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
        ours |= {"DOCKER_HOST": f"unix://{self.engine.socket}", "DOCKER": self.engine.docker}
        ours |= {"BT_STUDIO_ENV_FILE": str(self._file), "COMPOSE_PROJECT_NAME": self.name}
        return ours | {"BT_STUDIO_VERSION": self._tag}

    def compose(self, *arguments: str, **options: object) -> subprocess.CompletedProcess[str]:
        """Runs `docker/compose.sh`."""
        return _run((*self._command, *arguments), self.environment, **options)

    @property
    def _command(self) -> tuple[str, ...]:
        return (str(REPOSITORY / "docker" / "compose.sh"),)

    @property
    def settings(self) -> dict[str, str]:
        """Returns the values of the `.env`; the last line of a name counts."""
        lines = (line for line in self._file.read_text().splitlines() if not line.startswith("#"))
        return dict(line.split("=", 1) for line in lines)

    def trust(self) -> None:
        """Trusts only the server's own authority from now on."""
        self.tls = ssl.create_default_context(cafile=str(self.folder / "ca.crt"))

    def webs(self) -> list[str]:
        """Returns the running containers of the web server."""
        return self.compose("ps", "-q", "web").stdout.split()

    def add_user(self, name: str) -> User:
        """Creates an account and signs in."""
        password = secrets.token_urlsafe(12)
        self.studio("admin", "create", name, "--user", "--password-stdin", input=password + "\n")
        return User(self, name, password)
