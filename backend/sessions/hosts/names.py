"""The addresses of hosts, as the setting `BT_STUDIO_EXECUTOR_HOSTS` has them: HOST:PORT."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["HostAddress", "read_host"]


class HostAddress(NamedTuple):
    """Where the relay of a host listens; the name is that in its certificate."""

    name: str
    port: int

    def __str__(self) -> str:
        """Returns the address as the settings have it."""
        return f"[{self.name}]:{self.port}" if ":" in self.name else f"{self.name}:{self.port}"


def read_host(text: str) -> HostAddress:
    """Returns the parts of an address that the settings have checked."""
    name, _, port = text.rpartition(":")
    return HostAddress(name.strip("[]"), int(port))
