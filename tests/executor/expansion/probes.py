"""Harmless probes: robot files that try to read a file outside of the project, and to open a socket."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from tests.cli.typed import ROOT

if TYPE_CHECKING:
    from pathlib import Path

_CLASSES = "().__class__.__base__.__subclasses__()"
_REACHED = f"[c for x in [0] for c in {_CLASSES} if c.__name__ == 'catch_warnings']"
_BUILTINS = f"for c in {_REACHED} for b in [c()._module.__builtins__]"
_WORDS = ("cannot be read", "may not do that", "cannot open", "lies outside")


def probes(secret: Path) -> list[str]:
    """Returns a document that reads `secret`, one that lists its folder, and one that opens a socket.

    All are on the second line. What they get becomes the name of a link, or of an error.
    """
    tries = (
        f"${{xacro.load_yaml('{secret}')['word']}}",
        f"${{[b['open']('{secret}').read() {_BUILTINS}]}}",
        f"${{[b['__import__']('_socket').socket() {_BUILTINS}]}}",
    )
    head = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    return [f'{head}\n<link name="{text}"/></robot>' for text in tries]


def robot_of(probe: str) -> dict[str, bytes]:
    """Returns the files of a project's robot `r` whose URDF is a probe."""
    burger = ROOT / "executor" / "robots" / "burger" / "robot.yaml"
    config = re.sub(r"(?m)^urdf: .*$", "urdf: r.xacro", burger.read_text())
    return {"robots/r/robot.yaml": config.encode(), "robots/r/r.xacro": probe.encode()}


def was_refused(said: str) -> bool:
    """Returns whether a text says that a probe was refused, and has nothing of the secret."""
    return "hidden" not in said and any(word in said for word in _WORDS)
