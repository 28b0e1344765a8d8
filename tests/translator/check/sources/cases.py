"""Shared by the tests of users' Python: findings about one source, as (code, severity, line)."""

from __future__ import annotations

from translator import inspect_action
from translator.check.sources import source_findings

HEAD = "import py_trees\nfrom py_trees.common import Status\n"
BASE = f"{HEAD}class A(py_trees.behaviour.Behaviour):\n"
UPDATE = "    def update(self):\n        return Status.SUCCESS\n"
FIRST = len(BASE.splitlines()) + 1
"""The first line of the class's body."""


def found_in(source: str, files: dict[str, bytes] | None = None) -> list[tuple[str, str, int]]:
    """The findings about the source of an action A, whose project has no other files by default."""
    action = inspect_action(source, "actions/A.py")
    found = source_findings(action, {"actions/A.py": source.encode(), **(files or {})})
    return [(item.code, item.severity.value, item.place.line) for item in found]
