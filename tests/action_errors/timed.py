"""The rows of callbacks for behaviour tests, which have no ROS: a control node with a timer of the tree."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from tests.action_errors.rows import LEAF, Row

if TYPE_CHECKING:
    from pathlib import Path

TIMED: Final = """from tree_gardener import ControlNode, Status


def fail():
    raise ValueError("no arm")


class Subject(ControlNode):
    def update(self):
        if self.status is not Status.RUNNING:
            self.start_timer(0.15, fail)
        UPDATE
"""
UPDATES: Final = {
    "callback": "return self.tick_child(0)",
    "callback-idle": "return Status.SUCCESS",
}


def sources(row: Row, marks: Path) -> dict[str, str]:
    """Returns the sources of a row; its leaf below the control node notes how it ends."""
    subject = TIMED.replace("UPDATE", UPDATES[row.row])
    waits = LEAF.replace("NAME", "Waits").replace("RESULT", "RUNNING").replace("MARKS", str(marks))
    return {"Subject": subject, "Waits": waits}


def xml(row: Row) -> str:
    """Returns the tree of a row."""
    below, beside = ("<Waits/>", "") if row.row == "callback" else ("<AlwaysSuccess/>", "<Waits/>")
    return (
        '<root BTCPP_format="4"><BehaviorTree ID="Main"><Fallback><Sequence>'
        f"<Subject>{below}</Subject>{beside}</Sequence><AlwaysSuccess/></Fallback></BehaviorTree></root>"
    )
