"""The payload of a goal as entries."""

from __future__ import annotations

import pytest

from tree_gardener.ros_payload import PayloadError, blackboard_of, entries_of


def test_a_json_object_is_entries_and_the_text_is_one_too() -> None:
    board = blackboard_of('{"speed": 0.5, "names": ["a"], "on": true}')
    assert (board["speed"], board["names"], board["on"]) == (0.5, ["a"], True)
    assert board["payload"].startswith("{")
    assert blackboard_of("")["payload"] == ""


@pytest.mark.parametrize("text", ["", " \n", '"hello"', "[1, 2]", "12", "null", "true"])
def test_another_value_of_json_is_no_entries(text: str) -> None:
    assert entries_of(text) == {}
    assert blackboard_of(text)["payload"] == text


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"a"}', "line 1, column 5"),
        ("hello", "not JSON: Expecting value (line 1, column 1)"),
        ("[1,\n 2", "not JSON: Expecting ',' delimiter (line 2, column 3)"),
        ("[NaN]", "not JSON: NaN is not a number"),
        ("[" * 100_000, "not JSON"),
        ('{"a": NaN}', "NaN is not a number"),
        ('{"": 1}', "the member ''"),
        ('{"@a": 1}', "the member '@a'"),
        ('{"a b": 1}', "the member 'a b'"),
        ('{"a": null}', "'a' is null"),
        ('{"a": ' * 100_000, "not a JSON object"),
    ],
)
def test_a_wrong_payload_is_said(text: str, said: str) -> None:
    with pytest.raises(PayloadError, match="payload") as caught:
        blackboard_of(text)
    assert said in str(caught.value)
