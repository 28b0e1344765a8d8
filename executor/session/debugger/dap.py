"""Messages of the Debug Adapter Protocol as the session checks and changes them. Pure.

Clients name files as the project does (`actions/Turn.py`); the adapter names their place on the disk.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Any, Final

import msgspec

__all__ = ["CAPABILITIES", "MOST_BYTES", "OWN_SEQ", "Refused", "Request", "checked", "made_by_hand", "named"]

MOST_BYTES: Final = 1 << 20
OWN_SEQ: Final = 1_000_000_000
"""The first `seq` of the session's own messages; those of clients are less."""
LONGEST_PATH: Final = 1000
DEEPEST: Final = 40

ALLOWED: Final = frozenset(
    {
        "initialize",
        "setBreakpoints",
        "setExceptionBreakpoints",
        "configurationDone",
        "threads",
        "stackTrace",
        "scopes",
        "variables",
        "setVariable",
        "evaluate",
        "completions",
        "exceptionInfo",
        "continue",
        "next",
        "stepIn",
        "stepOut",
        "pause",
        "disconnect",
    }
)
CAPABILITIES: Final[dict[str, Any]] = {
    "supportsCompletionsRequest": True,
    "supportsConditionalBreakpoints": True,
    "supportsConfigurationDoneRequest": True,
    "supportsEvaluateForHovers": True,
    "supportsExceptionInfoRequest": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsSetVariable": True,
    "exceptionBreakpointFilters": [
        {"filter": "raised", "label": "Raised exceptions", "default": False},
        {"filter": "uncaught", "label": "Uncaught exceptions", "default": False},
        {"filter": "userUnhandled", "label": "Exceptions that leave the project's code", "default": False},
    ],
}
"""What the session answers to `initialize`: the part of debugpy's capabilities that `ALLOWED` can use."""
_READS: Final = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*|\[(-?\d+|'[^'\\]*'|\"[^\"\\]*\")\])*")


class Refused(Exception):  # noqa: N818 - an answer to a client
    """A message is refused: a code, a sentence, and what can be done."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.code, self.message, self.hint = code, message, hint


@dataclass(frozen=True)
class Request:
    """A request of a client."""

    seq: int
    command: str
    arguments: dict[str, Any]


def checked(message: dict[str, Any], folder: str) -> Request:
    """Returns a client's request, with the files of the run in `folder`.

    Raises:
        Refused: it is no request, too large, not allowed, or names a file outside of the project.
    """
    if len(msgspec.json.encode(message)) > MOST_BYTES:
        raise Refused("too_large", f"A message of the debugger has at most {MOST_BYTES >> 20} MiB.")
    seq, command = message.get("seq"), message.get("command")
    arguments = message.get("arguments") or {}
    is_request = message.get("type") == "request" and isinstance(command, str)
    if not is_request or type(seq) is not int or not 0 < seq < OWN_SEQ:
        raise Refused("bad_data", "A request of the debugger needs type, seq and command.")
    if str(command) not in ALLOWED:
        hint = f"It takes {', '.join(sorted(ALLOWED))}."
        raise Refused("not_allowed", f"The session does not pass on {str(command)[:100]!r}.", hint)
    if not isinstance(arguments, dict):
        raise Refused("bad_data", "The arguments of a request of the debugger are an object.")
    if command == "setBreakpoints":
        arguments = arguments | {"source": {"path": _in_folder(arguments.get("source"), folder)}}
    return Request(seq, str(command), arguments)


def _in_folder(source: Any, folder: str) -> str:
    path = source.get("path") if isinstance(source, dict) else None
    is_good = isinstance(path, str) and 0 < len(path) <= LONGEST_PATH and "\0" not in path
    parts = PurePosixPath(str(path)).parts if is_good else ()
    if not parts or parts[0] == "/" or ".." in parts:
        raise Refused("bad_path", "A breakpoint needs the path of a file of the project.")
    return f"{folder}/{'/'.join(parts)}"


def named(value: Any, folder: str, depth: int = 0) -> Any:
    """Returns a part of a message of the adapter, with files of the run named as in the project."""
    if depth > DEEPEST:
        return None
    if isinstance(value, list):
        return [named(each, folder, depth + 1) for each in value]
    if not isinstance(value, dict):
        return value
    return {
        key: each.removeprefix(f"{folder}/")
        if key == "path" and isinstance(each, str)
        else named(each, folder, depth + 1)
        for key, each in value.items()
    }


def made_by_hand(request: Request) -> str:
    """Returns what a request may change in the program, in words; "" if it only looks.

    A name, attribute or item that is shown (in a hover or watch) is a look; any other expression may write.
    """
    arguments = request.arguments
    if request.command == "setVariable":
        return f"{arguments.get('name')} = {arguments.get('value')}"
    if request.command != "evaluate":
        return ""
    expression = str(arguments.get("expression", "")).strip()
    is_look = arguments.get("context") in {"hover", "watch", "variables"} and _READS.fullmatch(expression)
    return "" if is_look else expression
