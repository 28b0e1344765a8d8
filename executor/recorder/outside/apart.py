"""Converts a file from outside in a child with limits, so that a hostile file harms nothing but itself.

The child has 256 MB, 60 s, and no network where the platform lets it give that up. It reads the source and
writes the target, and prints the result as one line of JSON.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.outside.convert import Converted, convert_outside
from executor.recorder.outside.errors import OutsideError
from executor.recorder.reader import RecordingError
from executor.supervision.confine import confine_reader

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["command", "convert_apart", "main", "outcome"]

MEMORY_BYTES: Final = 256 << 20
MOST_WRITTEN_BYTES: Final = 2 << 30
SECONDS: Final = 60
_GRACE_S: Final = 5.0
_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH", "AMENT_PREFIX_PATH")
_LARGE: Final = "Cut the part of the log that matters."


def convert_apart(source: Path, target: Path, name: str = "") -> Converted:
    """Writes a file, or a folder of a bag, as a recording; nothing of it is read in this process.

    Raises:
        OutsideError: it is no log that can be read, or it exceeds a limit.
    """
    name = name or source.name
    environment = {key: os.environ[key] for key in _PASSED if key in os.environ}
    try:
        done = subprocess.run(
            command(source, target, name),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            env=environment,
            timeout=SECONDS + _GRACE_S,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        raise _too_long(name) from error
    return outcome(name, done.returncode, done.stdout)


def command(source: Path, target: Path, name: str) -> list[str]:
    """Returns the command of the child."""
    return [sys.executable, "-m", "executor.recorder.outside", str(source), str(target), name]


def outcome(name: str, code: int, output: bytes) -> Converted:
    """Returns the result that the child printed.

    Raises:
        OutsideError: it printed an error, or ended without any output.
    """
    try:
        told = json.loads(output.decode())
    except ValueError:
        if code < 0:  # ended by the limit of processor time
            raise _too_long(name) from None
        text = f"it needs more than {MEMORY_BYTES >> 20} MB to be read"
        raise OutsideError("too_large", name, 0, text, _LARGE) from None
    if "code" in told:
        raise OutsideError(told["code"], name, told["place"], told["message"], told["hint"])
    return Converted(**told)


def main(arguments: Sequence[str]) -> int:
    """The main function of the child: drops privileges that it does not need, and converts."""
    source, target, name = Path(arguments[0]), Path(arguments[1]), arguments[2]
    confine_reader(MEMORY_BYTES, SECONDS, MOST_WRITTEN_BYTES)
    try:
        with target.open("wb") as out:
            told: dict[str, Any] = vars(convert_outside(source, out, name=name))
    except OutsideError as error:
        told = {"code": error.code, "place": error.offset, "message": error.message, "hint": error.hint}
    except RecordingError as error:
        told = {"code": "damaged", "place": error.offset, "message": error.message, "hint": error.hint}
    except MemoryError:
        return 1  # the parent says why
    except OSError as error:
        told = {"code": "damaged", "place": 0, "message": error.strerror or str(error), "hint": _LARGE}
    sys.stdout.write(json.dumps(told))
    return 0 if "code" not in told else 1


def _too_long(name: str) -> OutsideError:
    return OutsideError("too_long", name, 0, f"reading took more than {SECONDS} s", _LARGE)
