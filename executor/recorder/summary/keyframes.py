"""Finds the state of a world in the segments of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from mcap.records import Channel, Message

from executor.recorder.cdr import decode
from executor.recorder.definitions import OURS
from executor.recorder.reader import RecordingError, RecordReader

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

__all__ = ["Found", "find_keyframe"]

TOPIC = "/bt/keyframe"


class Found(NamedTuple):
    """The state of a world, and the blackboard, at a time in ns."""

    t_ns: int
    world: bytes
    blackboard_json: str


def find_keyframe(files: Iterable[Path], until_ns: int | None) -> Found | None:
    """Returns the last keyframe with a world that is not later than a time; None if there is none.

    Args:
        files: the segments of a run, the newest first. What is damaged in one is left out.
        until_ns: the latest time; None for the end.
    """
    for path in files:
        found = _in_file(path, until_ns)
        if found is not None:
            return found
    return None


def _in_file(path: Path, until_ns: int | None) -> Found | None:
    last: Found | None = None
    kinds: dict[int, bool] = {}
    try:
        with path.open("rb") as file:
            for record in RecordReader(file, path.name):
                if isinstance(record, Channel):
                    kinds[record.id] = record.topic == TOPIC
                elif isinstance(record, Message) and kinds.get(record.channel_id):
                    if until_ns is not None and record.log_time > until_ns:
                        break
                    fields = decode(f"{OURS}/msg/Keyframe", record.data)
                    if fields["world"]:
                        last = Found(record.log_time, bytes(fields["world"]), fields["blackboard_json"])
    except (OSError, RecordingError):
        pass
    return last
