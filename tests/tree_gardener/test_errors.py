"""Errors with their place."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import load
from tree_gardener.errors import Diagnostic, LoadError, ScriptError, TickError, describe


def test_a_diagnostic_is_one_line_with_its_hint() -> None:
    found = Diagnostic("TG102", "it is empty", "write it", file="a.xml", line=2, column=3)
    assert str(found) == "a.xml:2:3: TG102 it is empty (write it)"
    assert found.to_json()["code"] == "TG102"
    assert str(LoadError([found, found])).count("\n") == 1


def test_a_tick_error_names_the_node_and_the_users_line() -> None:
    with pytest.raises(TickError) as raised:
        load("<Sequence><Raising name='r'/></Sequence>").tick_exactly_once()
    error = raised.value
    assert (error.path, error.node_type) == ("r", "Raising")
    assert error.file.endswith("trees.py")
    assert "tree_gardener/node.py" not in error.traceback_text
    assert isinstance(error.cause, ValueError)


def test_an_exception_is_described_in_one_line() -> None:
    assert describe(ValueError("no")) == "ValueError: no"
    assert describe(KeyboardInterrupt()) == "KeyboardInterrupt"
    assert describe(SystemExit(3)) == "the action called sys.exit(3)"
    assert str(ScriptError((0, 1), "bad", "do so")) == "bad (do so)"
