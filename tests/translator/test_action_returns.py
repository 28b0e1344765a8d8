from __future__ import annotations

import pytest

from translator.action_returns import returned_statuses

HEAD = "import py_trees\nclass A(py_trees.behaviour.Behaviour):\n    def update(self):\n        "


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("return py_trees.common.Status.RUNNING", "RUNNING"),
        ("if x:\n            return Status.SUCCESS\n        return Status.FAILURE", "FAILURE SUCCESS"),
        ("return Status.SUCCESS if x else Status.RUNNING", "RUNNING SUCCESS"),
        ("return self.result()", ""),
        ("if x:\n            return self.result\n        return Status.SUCCESS", ""),
        ("return Status.SUCCESS if x else y", ""),
        ("def inner():\n            return 3\n        return Status.SUCCESS", "SUCCESS"),
        ("return Mine.SUCCESS", ""),
        ("return", ""),
        ("pass", ""),
    ],
)
def test_the_results_of_update(body, expected):
    assert " ".join(sorted(returned_statuses(HEAD + body, "A"))) == expected


@pytest.mark.parametrize(
    "source", ["", "class A(", "class B:\n    def update(self): return Status.SUCCESS", "x" * 9]
)
def test_other_sources_say_nothing(source):
    assert returned_statuses(source, "A") == frozenset()
