"""Values of the blackboard in recordings."""

from __future__ import annotations

import json
from typing import Any

import pytest

from executor.recorder.values import canonical, fingerprint, value_json


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ({"b": 1, "a": [True, None, 0.5]}, '{"a":[true,null,0.5],"b":1}'),
        ((1, "é"), '[1,"é"]'),
        (float("nan"), None),
        (object(), None),
        ({1: 2}, None),
        ([[1] * 200] * 200, None),
    ],
)
def test_equal_values_have_one_form(value, text):
    assert canonical(value) == text


def test_a_value_that_holds_itself_has_none():
    value: list = []
    value.append(value)
    assert canonical(value) is None


def test_large_and_foreign_values_are_previews():
    assert value_json([1, 2], str) == "[1,2]"
    assert json.loads(value_json(object(), lambda _: "a thing")) == {"preview": "a thing"}
    large = json.loads(value_json("x" * 5000, lambda _: "xx…"))
    assert (large["preview"], large["bytes"], len(large["hash"])) == ("xx…", 5002, 16)
    assert value_json("x" * 4094, str) == json.dumps("x" * 4094)


def test_each_part_of_a_tick_changes_its_fingerprint():
    parts: list[tuple[Any, Any, Any, Any]] = [
        (1, [(1, 2)], [], []),
        (2, [(1, 2)], [], []),
        (1, [(1, 3)], [], []),
        (1, [], [(1, 2)], []),
        (1, [(1, 2)], [], [("", "k", "int", "1")]),
        (1, [(1, 2)], [], [("", "k", "int", "2")]),
        (1, [(1, 2)], [], [("", "k", "Thing", None)]),
    ]
    prints = [fingerprint(*part) for part in parts]
    assert len(set(prints)) == len(parts)
    assert all(0 <= one < 2**64 for one in prints)
    assert prints[0] == fingerprint(*parts[0])


def test_a_value_that_reads_like_a_preview_is_one():
    assert json.loads(value_json({"preview": "mine"}, lambda _: "{'preview': 'mine'}")) == {
        "preview": "{'preview': 'mine'}",
        "bytes": 18,
        "hash": json.loads(value_json({"preview": "mine"}, str))["hash"],
    }
    assert json.loads(value_json({"preview": 1}, str)) == {"preview": 1}
    assert json.loads(value_json({"preview": "a", "more": 1}, str)) == {"preview": "a", "more": 1}
