"""The running tree in the format of JdeRobot BT Studio's monitor: a JSON text in `update` messages."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from executor.session.mirror import Mirror

__all__ = ["update_text"]

_STATES: Final = {"IDLE": "INVALID", "SKIPPED": "INVALID"}


def update_text(mirror: Mirror) -> str:
    """Returns the tree and the blackboard as JSON.

    Nodes are keyed by name within their parent, and each has its `state`.
    """
    top: dict[str, Any] = {}
    by_uid: dict[int, dict[str, Any]] = {}
    for node in mirror.tree.nodes if mirror.tree is not None else []:
        status = mirror.statuses.get(node.uid, "IDLE")
        by_uid[node.uid] = {"state": _STATES.get(status, status)}
        siblings = by_uid.get(node.parent, top)
        name, count = node.name or node.type, 2
        while name in siblings:
            name, count = f"{node.name or node.type}_{count}", count + 1
        siblings[name] = by_uid[node.uid]
    board = {
        f"{entry.scope}/{entry.key}" if entry.scope else entry.key: str(entry.value)
        for entry in mirror.blackboard.values()
    }
    return json.dumps({"tree": top, "blackboard": board}, ensure_ascii=False)
