"""Makes messages of a recording from events that have no type of their own. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["message_of"]


def message_of(
    name: str, t_ns: int, data: Mapping[str, Any], uid: int
) -> tuple[str, str, dict[str, Any]] | None:
    """Returns topic, type and fields of an event `log`, `fault`, `finished` or `flag`; None for others.

    Raises:
        KeyError: the data are not those of the event.
    """
    line: dict[str, Any]
    match name:
        case "log":
            line = {"source": data["source"], "level": data["level"], "text": data["text"]}
        case "flag":
            line = {"source": "flag", "level": "info", "text": data["text"]}
        case "finished":
            text = data.get("message") or f"The tree ended with {data['status']}."
            line = {"source": "session", "level": "info", "text": text}
        case "fault":
            fault = {part: data.get(part) or "" for part in ("kind", "file", "message", "traceback")}
            fault |= {"stamp": t_ns, "line": data.get("line") or 0, "uid": uid}
            return "/bt/fault", "Fault", fault
        case _:
            return None
    return "/bt/log", "Log", line | {"stamp": t_ns, "uid": uid}
