"""A report grows from events and frames."""

from __future__ import annotations

import struct

from executor import messages
from executor.headless.measured import Measured

TREE = {"nodes": [{"uid": 1, "path": "S"}, {"uid": 2, "path": "S/a"}]}


def tick(n: int, changed: list[tuple[int, str]], flashed: list[tuple[int, str]]) -> dict[str, object]:
    return {"n": n, "duration_ms": 60.0, "changed": changed, "flashed": flashed}


def test_ticks_of_nodes_are_counted_by_result() -> None:
    measured = Measured()
    measured.take_event("tree", TREE, 0.0)
    measured.take_event("tick", tick(1, [(1, "RUNNING")], [(2, "SUCCESS")]), 1.0)
    measured.take_event("tick", tick(3, [(1, "IDLE")], [(1, "FAILURE")]), 1.1)
    measured.take_event("fault", {"kind": "exception"}, 1.1)
    measured.take_event("finished", {"status": "FAILURE"}, 1.1)
    report = measured.end(0.2)
    assert [(node.path, node.ticks, node.success, node.failure) for node in report.nodes] == [
        ("S", 2, 0, 1),
        ("S/a", 1, 1, 0),
    ]
    assert (report.root_status, report.ticks, report.overruns, len(report.errors)) == ("FAILURE", 3, 2, 1)
    assert measured.finished


def test_the_nearest_range_of_all_scans_is_kept() -> None:
    measured = Measured()
    for ranges in ((3.0, float("inf"), 0.0), (2.0, 5.0), (4.0,)):
        data = struct.pack(f"<{len(ranges)}f", *ranges)
        measured.take_frame(scan_of(data))
    assert measured.report.min_range_m == 2.0


def scan_of(ranges: bytes) -> messages.Scan:
    import msgspec

    fields = {field.encode_name: 0.0 for field in msgspec.structs.fields(messages.Scan) if field.required}
    texts = {name: "" for name in fields if name in {"sensor", "name", "robot", "frame"}}
    return msgspec.convert(
        {"type": "scan", **fields, **texts, "ranges": ranges, "pose": [0.0] * 7}, messages.Scan, strict=False
    )
