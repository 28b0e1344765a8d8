"""An action that writes all hostile values to the blackboard, one a tick, in all ways to write."""

from __future__ import annotations

from pathlib import Path
from typing import Final

_VALUES: Final = Path(__file__).with_name("hostile_values.py").read_text()
_ACTION: Final = """
import py_trees

from tree_gardener.ports import Port, set_output


class Act(py_trees.behaviour.Behaviour):
    OUTPUT_PORTS = {"one": Port(object)}

    def __init__(self, name):
        super().__init__(name)
        self.count = 0

    def update(self):
        if self.count == len(VALUES):
            print("all written")
            return py_trees.common.Status.SUCCESS
        value = VALUES[self.count]
        set_output(self, "one", value)
        self.tree_gardener_node.board["two"] = [value]
        self.tree_gardener_node.board[f"three_{self.count}"] = {"a": value}
        self.feedback_message = value
        self.count += 1
        return py_trees.common.Status.RUNNING
"""
SOURCE: Final = _VALUES + _ACTION
"""It prints "all written" and succeeds when all values were written."""
_RAISING: Final = """
import py_trees


class Act(py_trees.behaviour.Behaviour):
    count = -1

    def update(self):
        print("half a character", chr(0xD800))
        self.count += 1
        if self.count < len(errors()):
            raise errors()[self.count]
        print("all raised")
        return py_trees.common.Status.SUCCESS
"""
RAISING: Final = _VALUES + _RAISING
"""It raises all hostile exceptions, one an update, prints "all raised" and succeeds."""
