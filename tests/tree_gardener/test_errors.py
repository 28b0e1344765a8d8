"""Errors with their place."""

from __future__ import annotations

import py_trees
import pytest

from tests.tree_gardener.trees import load
from tree_gardener.actions import load_actions
from tree_gardener.errors import (
    Diagnostic,
    LoadError,
    ScriptError,
    TickError,
    describe,
    place_of,
    raised_at,
)


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


@pytest.mark.parametrize(
    ("body", "message", "line"),
    [
        ("    def update(self, more):\n        pass\n", "missing 1 required", 5),
        ("    def update(self):\n        pass\n", "returned nothing", 5),
        ("    NODE_KIND = 'SyncAction'\n    def update(self):\n        return RUNNING\n", "SyncAction", 6),
        ("    def update(self):\n        x = 1\n        return x / 0\n", "ZeroDivisionError", 7),
    ],
)
def test_a_fault_without_a_line_of_the_user_names_the_class(body: str, message: str, line: int) -> None:
    head = "import py_trees\nRUNNING = py_trees.common.Status.RUNNING\n\n"
    source = f"{head}class Own(py_trees.behaviour.Behaviour):\n{body}"
    with pytest.raises(TickError, match=message) as raised:
        load("<Own/>", nodes=load_actions({"Own": source})).tick_exactly_once()
    assert (raised.value.file, raised.value.line) == ("actions/Own.py", line)


def test_a_class_is_found_by_its_own_methods() -> None:
    class Empty(py_trees.composites.Sequence):
        pass

    assert place_of(Empty) == (__file__, 1)
    assert place_of(py_trees.composites.Sequence) == ("", 0)
    with pytest.raises(ValueError, match="no") as raised:
        raise ValueError("no")
    assert raised_at(raised.value)[0] == __file__


def test_an_exception_is_described_in_one_line() -> None:
    assert describe(ValueError("no")) == "ValueError: no"
    assert describe(KeyboardInterrupt()) == "KeyboardInterrupt"
    assert describe(SystemExit(3)) == "the action called sys.exit(3)"
    assert str(ScriptError((0, 1), "bad", "do so")) == "bad (do so)"
