"""Adds examples to the OpenAPI document: recorded requests to a real server, with their answers.

`tests/backend/test_examples.py` records `examples.json`. It makes the same requests at each run, and fails if
an answer differs from the recorded one.
"""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

RECORDED: Final = Path(__file__).with_name("examples.json")
PARAMETERS: Final = {
    "project_id": "3f2504e0-4f89-41d3-9a0c-000000000001",
    "session_id": "3f2504e0-4f89-41d3-9a0c-000000000009",
    "group_id": "3f2504e0-4f89-41d3-9a0c-000000000005",
    "path": "actions/Forward.py",
    "number": 2,
    "username": "ben",
    "robot_id": "turtlebot3",
    "universe_id": "empty_room",
    "search": "follow",
    "Idempotency-Key": "create-patrol-1",
}


@lru_cache(maxsize=1)
def recorded() -> dict[str, dict[str, Any]]:
    """Returns the examples by operation: `request`, and `answers` by status."""
    if not RECORDED.exists():
        return {}
    found: dict[str, dict[str, Any]] = json.loads(RECORDED.read_text(encoding="utf-8"))
    return found


def illustrate(result: dict[str, Any], **_: object) -> dict[str, Any]:
    """Adds the examples to a document; a hook of drf-spectacular."""
    for operations in result["paths"].values():
        for operation in operations.values():
            _illustrate(operation, recorded().get(operation["operationId"], {}))
    return result


def _illustrate(operation: dict[str, Any], example: dict[str, Any]) -> None:
    for parameter in operation.get("parameters", []):
        if parameter["name"] in PARAMETERS:
            parameter["example"] = PARAMETERS[parameter["name"]]
    if "request" in example:
        _put(operation["requestBody"]["content"], example["request"])
    responses = operation["responses"]
    for status, answer in example.get("answers", {}).items():
        if status in responses:
            _put(responses[status].get("content", {}), answer)
        else:
            _put(responses["default"]["content"], answer, name=answer["code"])


def _put(content: dict[str, Any], value: Any, name: str = "usual") -> None:
    for media_type in content.values():
        media_type.setdefault("examples", {})[name] = {"value": value}
