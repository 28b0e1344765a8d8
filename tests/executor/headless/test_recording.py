"""A run as lines of JSON."""

from __future__ import annotations

import gzip
import json
from typing import TYPE_CHECKING

from executor.headless.recording import FORMAT, VERSION, Recording

if TYPE_CHECKING:
    from pathlib import Path


def test_events_are_lines_and_replies_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl.gz"
    with Recording(path, {"project": "P"}) as recording:
        recording.event({"command": "tick", "t": 1.0, "tick": 1, "data": {"n": 1}, "client": "x"})
        recording.event({"command": "ack", "data": {}})
    with gzip.open(path) as file:
        head, event = map(json.loads, file)
    assert head == {"format": FORMAT, "version": VERSION, "project": "P"}
    assert event == {"type": "event", "t": 1.0, "tick": 1, "command": "tick", "data": {"n": 1}}
