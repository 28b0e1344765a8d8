"""Reaches the two ports of a Groot2 publisher through the user's own `ssh`."""

from __future__ import annotations

import contextlib
import re
import shutil
import socket
import subprocess
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
from tree_gardener.groot import GrootError
from tree_gardener.groot.client import read_address

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["SCHEME", "Reached", "reached"]

SCHEME: Final = "ssh://"
LOCALHOST: Final = "127.0.0.1"
LOOK_S: Final = 0.1
GOODBYE_S: Final = 2.0
TRIES: Final = 50
_USER: Final = re.compile(r"[A-Za-z0-9_.][A-Za-z0-9_.-]*")


@dataclass(frozen=True)
class Reached:
    """Where a program is asked.

    Attributes:
        host, port: its address, or the near end of the tunnel.
        tunnel: `ssh`, if it forwards the ports.
    """

    host: str
    port: int
    tunnel: subprocess.Popen[bytes] | None = None

    def check(self) -> None:
        """Looks after the tunnel, when the program is silent.

        Raises:
            CliError: `ssh` has ended.
        """
        if self.tunnel is not None and (status := self.tunnel.poll()) is not None:
            raise CliError(f"ssh ended with status {status}, so the program cannot be reached any more")


@contextlib.contextmanager
def reached(address: str) -> Iterator[Reached]:
    """Yields where a program is asked; for `ssh://` while `ssh` forwards its ports.

    Args:
        address: `[ssh://[USER@]]HOST[:PORT]`. The port is that of the publisher; the user's own configuration
            of `ssh` says how the host is reached.

    Raises:
        CliError: the address is wrong, or `ssh` is missing or ends.
    """
    user, host, port = _parts(address)
    if not address.startswith(SCHEME):
        yield Reached(host, port)
        return
    program = shutil.which("ssh")
    if program is None:
        raise CliError("ssh is not installed; without it, name the program as HOST:PORT")
    local = _free_ports()
    forwards = [f"{LOCALHOST}:{local + more}:localhost:{port + more}" for more in (0, 1)]
    command = [program, "-N", "-o", "ExitOnForwardFailure=yes", "-L", forwards[0], "-L", forwards[1]]
    with subprocess.Popen([*command, "--", f"{user}{host}"]) as process:  # it may ask for a password
        try:
            _wait(process, local, host)
            yield Reached(LOCALHOST, local, process)
        finally:
            process.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(GOODBYE_S)
            process.kill()


def _parts(address: str) -> tuple[str, str, int]:
    """Returns `USER@` or nothing, the host, and the port."""
    user, at, rest = "", "", address.removeprefix(SCHEME)
    if address.startswith(SCHEME) and "@" in rest:
        user, at, rest = rest.partition("@")
        if _USER.fullmatch(user) is None:
            raise CliError(f"'{user[:100]}' is no name of a user for ssh", status=BAD_ARGUMENTS)
    try:
        host, port = read_address(rest)
    except GrootError as error:
        raise CliError(str(error), status=BAD_ARGUMENTS) from error
    if address.startswith(SCHEME) and host.startswith("-"):
        raise CliError(f"'{host[:100]}' is no host: ssh takes it for an option", status=BAD_ARGUMENTS)
    return user + at, host.strip("[]") if address.startswith(SCHEME) else host, port


def _free_ports() -> int:
    """Returns the first of two free ports that follow each other."""
    for _ in range(TRIES):
        with socket.socket() as first, socket.socket() as second:
            first.bind((LOCALHOST, 0))
            port = int(first.getsockname()[1])
            with contextlib.suppress(OSError, OverflowError):
                second.bind((LOCALHOST, port + 1))
                return port
    raise CliError("no two free ports that follow each other were found on this computer")


def _wait(process: subprocess.Popen[bytes], port: int, host: str) -> None:
    """Waits until `ssh` listens; the user may have to give a password first."""
    while True:
        if (status := process.poll()) is not None:
            raise CliError(f"ssh to {host} ended with status {status}; what it says stands above")
        with contextlib.suppress(OSError), socket.create_connection((LOCALHOST, port), LOOK_S):
            return
        time.sleep(LOOK_S)
