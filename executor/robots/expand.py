"""Turns xacro and SDF into URDF.

The conversion runs only in processes that load a robot, never in the web server.
"""

from __future__ import annotations

import contextlib
import io
import logging
import re
from pathlib import Path

from executor.robots.sdf_model import urdf_of_sdf
from executor.robots.urdf import UrdfError

_log = logging.getLogger(__name__)


def urdf_of(path: Path) -> bytes:
    """Returns the URDF of a file: converts `.sdf`, expands `.xacro`, and returns other files unchanged.

    Raises:
        UrdfError: the SDF or the macros are wrong.
        OSError: it cannot be read.
    """
    if path.suffix == ".sdf":
        return _urdf_of_sdf(path)
    if path.suffix != ".xacro":
        return path.read_bytes()
    import xacro  # noqa: PLC0415 - few robots need it

    path.stat()  # a missing file gets our own error text
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            document = xacro.process_file(str(path))
        return bytes(document.toprettyxml(indent="  ", encoding="utf-8"))
    except Exception as error:  # xacro evaluates expressions of users, which may raise anything
        text = _in_words(error)
        line = getattr(error, "lineno", None) or _line_of(text, path)
        raise UrdfError(text, path.name, line) from error


def _urdf_of_sdf(path: Path) -> bytes:
    made = urdf_of_sdf(path.read_bytes(), path.name)
    for problem in made.left_out:
        _log.warning("%s:%s", path.name, problem)
    return made.urdf


def _line_of(message: str, path: Path) -> int:
    """Returns the line of an error message: xacro names the element without its line."""
    words = [word for pair in re.findall(r"'([^']+)'|(xacro:\w+)", message) for word in pair if word]
    names = [*words, *(Path(word).name for word in words if "/" in word)]
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    return next((i for name in names for i, line in enumerate(lines, 1) if name in line), 1)


def _in_words(error: Exception) -> str:
    text = str(error).strip() or type(error).__name__
    macros = getattr(error, "macros", None)
    names = ", ".join(str(getattr(macro, "name", macro)) for macro in macros or ())
    return f"xacro: {text}" + (f" (in {names})" if names else "")
