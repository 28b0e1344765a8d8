"""A long session in compressed time stays in its bounds of disk and memory, and keeps ten minutes."""

from __future__ import annotations

import random
import struct
from typing import TYPE_CHECKING, Any

import msgspec
import psutil
import pytest

from executor.messages import Poses
from executor.recorder.moment import SEGMENT_NS
from executor.recorder.run_writer import RunWriter
from executor.recorder.shelf import PICTURE, Budgets, Shelf
from tests.budget import count

if TYPE_CHECKING:
    from pathlib import Path

SECOND = 1_000_000_000
SCAN = "sensor_msgs/msg/LaserScan"
PICTURE_BYTES = 12_000
GROWTH_BYTES = 48 << 20
TEN_MINUTES_NS = 600 * SECOND


@pytest.mark.timeout(1800)  # some 30 s of processor time for an hour
def test_an_hour_stays_in_its_bounds_of_disk_and_memory(tmp_path: Path) -> None:
    chance = random.Random(1)  # noqa: S311 - reproducible data, no secret
    shelf = Shelf(tmp_path, lambda _: None)
    writer = RunWriter(shelf, "a1", {}, {"project/a.py": chance.randbytes(20_000)})
    scans = [chance.randbytes(1500) for _ in range(8)]
    process = psutil.Process()
    at_start, most, minutes = 0, 0, count("recorder_session_minutes")
    budgets, open_bytes = Budgets(), 0
    write_tree(writer)
    for second in range(minutes * 60):
        write_second(writer, second, chance, scans)
        writer.flush()
        open_bytes = max(open_bytes, writer.open_segment.bytes)
        if second == 120:
            at_start = process.memory_info().rss
        if second % 20 == 0:
            size = sum(path.stat().st_size for path in tmp_path.rglob("*") if path.is_file())
            most = max(most, size)
    assert process.memory_info().rss - at_start < GROWTH_BYTES
    # Pictures of an ended segment are counted when it ends, and while one is written again both are there.
    assert most <= budgets.pictures + budgets.others + 2 * open_bytes
    pictures = sum(one.picture_bytes for one in shelf.segments)
    assert budgets.pictures / 4 < pictures <= budgets.pictures
    first, last = shelf.segments[0], shelf.segments[-1]
    assert last.to_ns - first.from_ns >= TEN_MINUTES_NS - SEGMENT_NS
    numbers = [one.number for one in shelf.segments]
    assert numbers == list(range(numbers[0], numbers[-1] + 1))
    writer.end()


def write_tree(writer: RunWriter) -> None:
    texts = ("type", "kind", "name", "path", "node_id", "tree_id", "ports_json")
    tree: dict[str, Any] = {"generation": 1, "uid": list(range(1, 31)), "parent": [0] + [1] * 29}
    tree |= {name: [f"{name} {uid}" for uid in range(30)] for name in texts}
    writer.record("/bt/tree", "Tree", {"stamp": 0, **tree})


def write_second(writer: RunWriter, second: int, chance: random.Random, scans: list[bytes]) -> None:
    """Writes a simulated second at the rates of a usual session with one camera."""
    for step in range(60):
        t_ns = second * SECOND + step * SECOND // 60
        if step % 3 == 0:
            tick: dict[str, Any] = {
                "generation": 1,
                "number": second * 20 + step // 3,
                "duration_ms": 1.0,
                "fingerprint": 1,
            }
            tick |= {"changed_uid": [3, 4], "changed_status": b"\1\0", "flashed_uid": [5]}
            writer.record("/bt/tick", "Tick", {"stamp": t_ns, "flashed_status": b"\2", **tick})
        if step % 2 == 0:
            ids = struct.pack("<10H", *range(10))
            frame = msgspec.msgpack.encode(Poses(t=t_ns * 1e-9, ids=ids, poses=chance.randbytes(160)))
            writer.record("/world/poses", "Poses", {"stamp": t_ns, "data": frame})
        if step % 6 == 0:
            writer.write("/scan", SCAN, t_ns, scans[chance.randrange(8)])
            writer.write("/camera/image_raw/compressed", PICTURE, t_ns, chance.randbytes(PICTURE_BYTES))
        if step % 2 == 0:
            writer.write("/odom", "nav_msgs/msg/Odometry", t_ns, chance.randbytes(100) + bytes(600))
    if second % 5 == 0:
        world = chance.randbytes(20_000)
        writer.record("/bt/keyframe", "Keyframe", writer.moment.keyframe((second + 1) * SECOND - 1, 0, world))
