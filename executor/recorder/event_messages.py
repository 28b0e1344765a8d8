"""Makes messages of a recording from events that have no type of their own. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor.recorder.values import value_json

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["input_fields", "message_of"]

MOST_CHARACTERS: Final = 500
STEP_HZ: Final = 240.0
"""Steps of the simulated world in a second of its time."""


def input_fields(t_s: float, command: str, data: Any, tick: int | None, hook: int = -1) -> dict[str, Any]:
    """Returns the fields of an `Input`: what a person did at the `hook`-th stop of a tick, -1 between two.

    With None as its tick, the recorder adds the number of the last one. Large data are a preview.
    """
    return {
        "stamp": max(0, round(t_s * 1e9)),
        "step": round(t_s * STEP_HZ),
        "tick": tick,
        "hook": hook,
        "command": command,
        "data_json": value_json(data, lambda value: str(value)[:MOST_CHARACTERS]),
        "user": "",
    }


def message_of(
    name: str, t_ns: int, data: Mapping[str, Any], uid: int
) -> tuple[str, str, dict[str, Any]] | None:
    """Returns topic, type and fields of an event that has a place in a recording; None for others.

    Raises:
        KeyError: the data are not those of the event.
    """
    line: dict[str, Any]
    match name:
        case "log":
            line = {"source": data["source"], "level": data["level"], "text": data["text"]}
        case "flag":
            flag = {part: data[part] for part in ("id", "text", "user")}
            return "/bt/flag", "Flag", flag | {"stamp": t_ns, "moment": max(0, round(data["t"] * 1e9))}
        case "recording_stopped":
            gap = {"stamp": t_ns, "reason": data["reason"], "text": data["detail"]}
            return "/bt/gap", "Gap", gap
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
