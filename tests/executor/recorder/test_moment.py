"""The state from which a segment begins."""

from __future__ import annotations

import json

import msgspec
import numpy as np

from executor.messages import Poses
from executor.recorder.moment import MOST_ENTRIES, Moment
from executor.stream.pose_codec import pack

TREE = {"generation": 3, "uid": [1, 2, 3], "path": ["Main", "Main/a", "Main/b"]}


def poses(t: float, *ids: int) -> dict[str, object]:
    rows = np.array([[t, 0, 0, 0, 0, 0, 1]] * len(ids), np.float32)
    frame = Poses(t=t, ids=np.array(ids, "<u2").tobytes(), poses=pack(rows))
    return {"data": msgspec.msgpack.encode(frame)}


def entries(*rows: tuple[str, str, str, str, bool]) -> dict[str, object]:
    names = ("scope", "key", "type", "value_json", "removed")
    return {name: [row[place] for row in rows] for place, name in enumerate(names)}


def test_an_empty_moment_has_no_head():
    assert Moment().head(5) == []


def test_the_head_holds_scene_all_poses_tree_and_keyframe():
    moment = Moment()
    moment.take("Scene", {"data": b"scene"})
    moment.take("Poses", poses(0.0, 1, 2))
    moment.take("Poses", poses(1.0, 2))
    moment.take("Tree", TREE)
    moment.take("Tick", {"number": 7, "changed_uid": [1, 2], "changed_status": bytes([1, 2])})
    moment.take("Blackboard", entries(("", "k", "int", "5", False), ("", "gone", "int", "1", False)))
    moment.take("Blackboard", entries(("", "gone", "int", "null", True)))
    scene, all_poses, tree, keyframe = moment.head(9)
    assert scene == ("/world/scene", "Scene", {"stamp": 9, "data": b"scene"})
    frame = msgspec.msgpack.decode(all_poses[2]["data"], type=Poses)
    assert np.frombuffer(frame.ids, "<u2").tolist() == [1, 2]
    assert tree[2] == TREE | {"stamp": 9}
    fields = keyframe[2]
    assert (fields["tick"], fields["generation"], fields["status"]) == (7, 3, bytes([1, 2, 0]))
    assert json.loads(fields["blackboard_json"]) == [["", "k", "int", 5]]
    assert moment.uid("Main/b") == 3
    assert moment.uid("nowhere") == 0


def test_the_head_holds_the_flags_that_were_not_removed():
    moment = Moment()
    for number, text in ((1, "one"), (2, "two"), (1, "")):
        moment.take("Flag", {"stamp": 3, "moment": number, "id": str(number), "text": text, "user": ""})
    [(topic, name, fields)] = moment.head(9)
    assert (topic, name) == ("/bt/flag", "Flag")
    assert fields == {"stamp": 9, "moment": 2, "id": "2", "text": "two", "user": ""}


def test_a_keyframe_of_the_application_replaces_the_state():
    moment = Moment()
    moment.take("Keyframe", {"tick": 1, "status": b"", "blackboard_json": "[]"})  # without a tree
    assert moment.tick == 0
    moment.take("Tree", TREE)
    told = {"tick": 4, "status": bytes([1, 2, 3]), "blackboard_json": '[["s","k","double",0.5]]'}
    moment.take("Keyframe", told)
    again = moment.keyframe(0, 8, b"world")
    assert (again["tick"], again["status"], again["step"], again["world"]) == (
        4,
        bytes([1, 2, 3]),
        8,
        b"world",
    )
    assert again["blackboard_json"] == '[["s","k","double",0.5]]'


def test_another_scene_forgets_the_poses_and_another_tree_the_statuses():
    moment = Moment()
    moment.take("Poses", poses(0.0, 5))
    moment.take("Scene", {"data": b"x"})
    moment.take("Tree", TREE)
    moment.take("Tick", {"number": 1, "changed_uid": [1], "changed_status": bytes([1])})
    moment.take("Tree", TREE)
    assert [topic for topic, _, _ in moment.head(0)] == ["/world/scene", "/bt/tree", "/bt/keyframe"]
    assert moment.keyframe(0, 0, b"")["status"] == bytes(3)


def test_the_entries_are_bounded():
    moment = Moment()
    moment.take("Blackboard", entries(*(("", f"k{i}", "int", "1", False) for i in range(MOST_ENTRIES + 9))))
    assert len(json.loads(moment.keyframe(0, 0, b"")["blackboard_json"])) == MOST_ENTRIES
