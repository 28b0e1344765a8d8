"""One message of each of our types, with every field set."""

from __future__ import annotations

from typing import Any

T_NS = 1_250_000_000

MESSAGES: dict[str, dict[str, Any]] = {
    "Tree": {
        "stamp": T_NS,
        "generation": 2,
        "uid": [1, 2],
        "parent": [0, 1],
        "type": ["Sequence", "Forward"],
        "kind": ["control", "action"],
        "name": ["root", "vorwärts"],
        "path": ["root", "root/vorwärts"],
        "node_id": ["a", "b"],
        "tree_id": ["Main", "Main"],
        "ports_json": ["{}", '{"lin_speed":"0.3"}'],
    },
    "Tick": {
        "stamp": T_NS,
        "generation": 2,
        "number": 7,
        "changed_uid": [1, 2],
        "changed_status": b"\x01\x02",
        "flashed_uid": [],
        "flashed_status": b"",
        "duration_ms": 1.5,
        "fingerprint": 2**63 + 5,
    },
    "Blackboard": {
        "stamp": T_NS,
        "tick": 7,
        "scope": ["", "root/part"],
        "key": ["goal", "é"],
        "type": ["int", "string"],
        "value_json": ["3", '"x"'],
        "removed": [False, True],
        "writer_uid": [2, 2**32 - 1],
    },
    "Forced": {"stamp": T_NS, "generation": 2, "tick": 7, "uid": [2, 3]},
    "Log": {"stamp": T_NS, "source": "action", "level": "info", "text": "The way is free", "uid": 2},
    "Profile": {
        "stamp": T_NS,
        "generation": 2,
        "ticks": 10,
        "uid": [1, 2],
        "calls": [10, 12],
        "total_ms": [2.5, 1.25],
        "self_ms": [1.25, 1.25],
    },
    "Fault": {
        "stamp": T_NS,
        "kind": "exception",
        "uid": 2,
        "file": "actions/Forward.py",
        "line": 19,
        "message": "NameError",
        "traceback": "Traceback …",
    },
    "Input": {
        "stamp": T_NS,
        "step": 300,
        "tick": 7,
        "hook": -1,
        "command": "teleop",
        "data_json": '{"linear":0.1}',
        "user": "ada",
    },
    "Flag": {"stamp": T_NS, "moment": 500_000_000, "id": "f1", "text": "Here it turns", "user": "ada"},
    "Gap": {"stamp": T_NS, "reason": "recorder_died", "text": "was killed by SIGKILL"},
    "Poses": {"stamp": T_NS, "data": b"\x83\xa5poses"},
    "Scene": {"stamp": T_NS, "data": b"\x83\xa5scene"},
    "Keyframe": {
        "stamp": T_NS,
        "step": 300,
        "tick": 7,
        "generation": 2,
        "status": b"\x01\x02",
        "blackboard_json": '[["","goal","int",3]]',
        "world": bytes(range(7)),
    },
}
