"""Actions that nobody has written yet."""

from __future__ import annotations

from tests.tree_gardener.trees import load
from tree_gardener.stubs import STUB_MARK, STUB_UPDATE, is_stub, stubs_sentence, unwritten

STUB = f"# {STUB_MARK}\nclass Go:\n{STUB_UPDATE}"


def test_a_stub_is_one_until_its_update_changes() -> None:
    assert is_stub(STUB)
    assert is_stub(STUB.replace("\n", "\r\n"))
    assert not is_stub(STUB.replace("FAILURE", "SUCCESS"))


def test_stubs_are_named_in_one_sentence() -> None:
    assert stubs_sentence(["Go"]).startswith("Go is an unwritten stub")
    assert stubs_sentence(["A", "B", "C"]).startswith("A, B and C are unwritten stubs")
    assert "actions/A.py, actions/B.py" in stubs_sentence(["A", "B"])


def test_classes_that_are_given_are_no_stubs() -> None:
    assert unwritten(load("<Succeeding/>")) == []
