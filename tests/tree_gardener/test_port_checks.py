"""Checks of the texts of ports."""

from __future__ import annotations

import pytest

from tree_gardener.blackboard import Blackboard
from tree_gardener.decorators.update import SkipUnlessUpdated
from tree_gardener.leaves.constant import AlwaysSuccess
from tree_gardener.leaves.scripts import Script
from tree_gardener.port_checks import check_text, declare_entry
from tree_gardener.ports import INPUT, OUTPUT, PortSpec
from tree_gardener.values import ANY, INT, STRING


@pytest.mark.parametrize(
    ("spec", "text", "code"),
    [
        (PortSpec("n", INPUT, INT), "5", None),
        (PortSpec("n", INPUT, INT), "{key}", None),
        (PortSpec("n", INPUT, INT), "five", "TG305"),
        (PortSpec("n", INPUT, INT), "{key", "TG303"),
        (PortSpec("n", OUTPUT, INT), "key", "TG304"),
        (PortSpec("n", OUTPUT, ANY), "key", None),
    ],
)
def test_a_literal_has_the_type_of_its_port(spec: PortSpec, text: str, code: str | None) -> None:
    problem = check_text(AlwaysSuccess, spec, text)
    assert (problem and problem.code) == code


def test_a_script_parses_or_has_the_place_of_its_error() -> None:
    spec = PortSpec("code", INPUT, STRING)
    assert check_text(Script, spec, "") is None
    assert check_text(Script, spec, "a := 1") is None
    problem = check_text(Script, spec, "a := ")
    assert problem is not None
    assert (problem.code, problem.span_start) == ("TG401", 5)


def test_an_entry_has_one_type() -> None:
    board = Blackboard()
    assert declare_entry(AlwaysSuccess, PortSpec("n", INPUT, INT), "{key}", board) is None
    entry = board.find("key")
    assert entry is not None
    assert entry.type is INT
    assert declare_entry(AlwaysSuccess, PortSpec("n", INPUT, INT), "literal", board) is None
    problem = declare_entry(AlwaysSuccess, PortSpec("s", INPUT, STRING), "{key}", board)
    assert problem is not None
    assert problem.code == "TG306"


def test_a_watched_entry_takes_no_strings_later() -> None:
    board = Blackboard()
    declare_entry(SkipUnlessUpdated, PortSpec("entry", INPUT, ANY), "{seen}", board)
    entry = board.find("seen")
    assert entry is not None
    assert entry.type is ANY
