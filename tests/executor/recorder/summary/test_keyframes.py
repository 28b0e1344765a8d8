"""Finds the state of a world in the segments of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.recorder.summary.keyframes import Found, find_keyframe
from executor.recorder.writer import RecordingWriter
from tests.executor.recorder.messages import MESSAGES

if TYPE_CHECKING:
    from pathlib import Path

SECOND = 1_000_000_000


def segment(path: Path, *times: int) -> Path:
    with path.open("wb") as file:
        writer = RecordingWriter(file, {})
        for t_s in times:
            head = {**MESSAGES["Keyframe"], "stamp": t_s * SECOND, "world": b""}
            writer.record("/bt/keyframe", "Keyframe", head)
            full = {**head, "world": b"%d" % t_s, "blackboard_json": f'[["","k","int",{t_s}]]'}
            writer.record("/bt/keyframe", "Keyframe", full)
        writer.finish()
    return path


def test_the_last_state_that_is_not_later_is_found(tmp_path: Path) -> None:
    files = [segment(tmp_path / "1", 20, 25, 30), segment(tmp_path / "0", 0, 5, 10)]
    for until_s, expected in ((None, 30), (26, 25), (25, 25), (19, 10), (4, 0)):
        found = find_keyframe(files, None if until_s is None else until_s * SECOND)
        assert found == Found(expected * SECOND, b"%d" % expected, f'[["","k","int",{expected}]]')
    assert find_keyframe(files[:1], 3 * SECOND) is None
    assert find_keyframe([], None) is None


def test_what_is_damaged_or_gone_is_left_out(tmp_path: Path) -> None:
    whole, cut, bad = (segment(tmp_path / name, 3) for name in ("0", "1", "2"))
    cut.write_bytes(cut.read_bytes()[:200])
    bad.write_bytes(b"no recording")
    found = find_keyframe([tmp_path / "none", bad, cut, whole], None)
    assert found is not None
    assert found.world == b"3"
