"""A layout of panels that a user can make by dragging: 3D, Video and Camera are behind the inspector.

A browser that draws WebGL by the processor takes half a processor for the view of a run, also where a walk
looks at other panels alone.
"""

from __future__ import annotations

import json
from typing import Any

__all__ = ["VIEWS_BEHIND"]


def _tabs(name: str, weight: int, *panels: str) -> dict[str, Any]:
    tabs = [
        {"type": "tab", "id": id_, "name": f"panel.{id_}", "component": id_, "enableClose": False}
        for id_ in panels
    ]
    keeps = {"enableDeleteWhenEmpty": name != "editors"}
    return {
        "type": "tabset",
        "id": name,
        "weight": weight,
        "selected": 0 if tabs else -1,
        "children": tabs,
    } | keeps


def _column(weight: int, *children: dict[str, Any]) -> dict[str, Any]:
    return {"type": "row", "weight": weight, "children": list(children)}


_FILES = _tabs("files", 42, "explorer", "outline", "search", "history")
_NODES = _tabs("nodes", 58, "palette", "library")
_OUTPUT = _tabs("output", 26, "console", "problems", "tests", "evaluate", "timeline", "topics")
_DETAILS = _tabs("details", 50, "inspector", "blackboard", "viewer3d", "video", "camera")
_LAYOUT = {
    "global": {
        "tabEnableRename": False,
        "tabEnablePopout": False,
        "tabSetEnableTabScrollbar": True,
        "tabSetMinHeight": 80,
        "tabSetMinWidth": 120,
    },
    "layout": {
        "type": "row",
        "children": [
            _column(17, _FILES, _NODES),
            _column(53, _tabs("editors", 74), _OUTPUT),
            _column(30, _DETAILS),
        ],
    },
}
VIEWS_BEHIND = f"localStorage['bts.layout.1.wide'] ??= {json.dumps(json.dumps(_LAYOUT))}"
"""A script that keeps this layout for pages that have none yet."""
