"""Finds the launch nodes that may offer the robot's navigation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["may_navigate"]

_PACKAGES: Final = "nav2_"
_INTERFACES: Final = b"nav2_msgs"
"""A program that offers Nav2's actions imports their interfaces; so does a client of them."""


def may_navigate(package: str, command: Sequence[str]) -> bool:
    """Returns whether a launch node may offer Nav2's actions: one of its own, or one with its interfaces.

    A program that has them from another file of its own is not found.
    """
    return package.startswith(_PACKAGES) or any(
        _has_interfaces(Path(word)) for word in command[:2] if word.endswith(".py")
    )


def _has_interfaces(program: Path) -> bool:
    try:
        return program.is_file() and _INTERFACES in program.read_bytes()
    except OSError:  # its start will say why it cannot be read
        return False
