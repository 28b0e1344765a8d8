"""A recording gets the known state of another program's tree, and then each change."""

from __future__ import annotations

from typing import Any

from executor.attached.followed_tree import FollowedTree
from executor.messages import TreeNode
from tree_gardener.status import Status

NODES = [
    TreeNode(1, 0, "Sequence", "Control", "top", "top", "u7", "Main"),
    TreeNode(2, 1, "Wait", "Action", "wait", "wait", "u8", "Main"),
]


class Written:
    """Takes what is written."""

    def __init__(self) -> None:
        self.records: list[tuple[str, dict[str, Any]]] = []
        self.attached: list[str] = []

    def record(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        self.records.append((name, fields))

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        self.attached.append(name)


def test_what_was_known_is_stated_at_the_begin_and_then_each_change() -> None:
    tree, out = FollowedTree(NODES, {7: 1, 8: 2}, b"<root/>", generation=3), Written()
    tree.correct({7: Status.RUNNING, 99: Status.SUCCESS}, 1.0)
    tree.written([("", "a", "int", "1", False), ("", "b", "int", "2", False)], 1.0)
    tree.written([("", "b", "int", "null", True)], 1.0)
    tree.restate(out)
    tree.take([(500_000, 0, 8, 2), (600_000, 0, 99, 2), (700_000, 0, 8, 5)], 1.0, 2.0)
    tree.end_step()
    assert out.attached == ["tree_4.xml"]
    assert [name for name, _ in out.records] == ["Tree", "Keyframe", "Tick", "Blackboard", "Tick"]
    fields = [fields for _, fields in out.records]
    assert (fields[0]["generation"], fields[0]["stamp"]) == (4, 1_000_000_000)
    assert (fields[2]["changed_uid"], fields[3]["key"]) == ([1], ["a"])
    assert (fields[4]["stamp"], fields[4]["changed_uid"]) == (1_500_000_000, [2])
    assert (tree.generation, tree.told_ns) == (4, 2_000_000_000)


def test_times_never_run_back_nor_into_the_future() -> None:
    tree, out = FollowedTree(NODES, {7: 1, 8: 2}), Written()
    tree.restate(out)
    tree.take([(0, 1, 7, 1), (0, 0, 8, 1)], 1.0, 2.0)
    tree.end_step()
    stamps = [fields["stamp"] for name, fields in out.records if name == "Tick"]
    assert stamps
    assert set(stamps) == {2_000_000_000}


def test_what_is_known_is_stated_again_for_another_recorder() -> None:
    tree = FollowedTree(NODES, {7: 1, 8: 2})
    tree.take([(0, 0, 7, 1), (0, 0, 8, 1)], 0.0, 1.0)
    for status in (1, 2):
        out = Written()
        tree.restate(out)
        tree.end_step()
        ticks = [fields for name, fields in out.records if name == "Tick"]
        assert [(tick["changed_uid"], tick["changed_status"]) for tick in ticks] == [
            ([1, 2], bytes([1, status]))
        ]
        tree.take([(0, 0, 8, 2)], 1.0, 2.0)
        tree.correct({8: Status.SUCCESS}, 2.0)
