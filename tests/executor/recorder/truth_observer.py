"""An action that observes the run in which it is, and writes down what it sees, one JSON line for each event.

It is copied into the application (`truth_app`), and uses nothing of the recorder.
"""

import gc
import json
import math
import pathlib
from typing import Any

import py_trees
from sensor_msgs.msg import LaserScan

from tree_gardener import Tree

PLACE = "/dev/null"
HEARS_SCANS = False


def plain(value: Any, depth: int = 0) -> bool:
    """Returns whether a value is made of JSON's types alone."""
    if depth > 50:
        return False
    if isinstance(value, float):
        return math.isfinite(value)
    if value is None or type(value) in (bool, int, str):
        return True
    if type(value) in (list, tuple):
        return all(plain(item, depth + 1) for item in value)
    return type(value) is dict and all(
        type(key) is str and plain(item, depth + 1) for key, item in value.items()
    )


def shown(value: Any) -> Any:
    """Returns [text] of a value that can be shown as a whole, or []."""
    if not plain(value) or value == {"preview": "no preview"}:  # which reads like a preview
        return []
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return [text] if len(text.encode()) <= 4096 else []


class TruthObserver(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs: Any) -> None:
        self.node = kwargs["node"]
        self.seen: dict[tuple[str, str], tuple[int, str]] = {}
        self.tree = next(
            tree
            for tree in gc.get_objects()
            if isinstance(tree, Tree)
            and any(getattr(node, "instance_behaviour", None) is self for node in tree.nodes)
        )
        nodes = [[node.uid, node.path, node.type] for node in self.tree.nodes]
        self.note("tree", nodes=nodes)
        self.tree.observe(self.ticked)
        if HEARS_SCANS:
            self.subscription = self.node.create_subscription(LaserScan, "/scan", self.heard, 10)

    def update(self) -> py_trees.common.Status:
        return py_trees.common.Status.SUCCESS

    @staticmethod
    def note(kind: str, **more: Any) -> None:
        """Writes a line; actions that import this module have another copy of it."""
        with pathlib.Path(PLACE).open("a", encoding="utf-8") as file:
            file.write(json.dumps({"kind": kind, **more}) + "\n")

    def heard(self, scan: LaserScan) -> None:
        t = scan.header.stamp.sec + scan.header.stamp.nanosec * 1e-9
        self.note("scan", t=t, ranges=[r if r < float("inf") else None for r in scan.ranges])

    def ticked(self, changes: Any) -> None:
        """Writes down the state after a tick: read from nodes and scopes, not from the changes."""
        entries, now = [], {}
        for board in self.tree.boards:
            for key, entry in board.entries.items():
                value = None if entry.type_name == "empty" else entry.value
                entries.append([board.path, key, entry.type_name, shown(value)])
                now[board.path, key] = entry.sequence, json.dumps(shown(value))
        in_place = [
            [*place]
            for place, (count, text) in now.items()
            if place in self.seen and self.seen[place][0] == count and self.seen[place][1] != text
        ]
        self.seen = now
        self.note(
            "tick",
            n=changes.tick,
            t=self.node.get_clock().now().nanoseconds * 1e-9,
            status={node.uid: node.status.name for node in self.tree.nodes if node.status.name != "IDLE"},
            flashed=[[uid, status.name] for uid, status in changes.flashed],
            entries=entries,
            # Entries that are declared and were never written have no writer.
            writes=[
                [c.scope, c.key, c.removed, c.writer_uid]
                for c in changes.blackboard
                if c.removed or c.type != "empty"
            ],
            in_place=in_place,
        )
