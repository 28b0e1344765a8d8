"""Nodes of version 3 as version 4 writes them."""

from __future__ import annotations

from translator.xml.v3 import upgrade


def test_old_types_and_ports_get_their_new_names() -> None:
    assert upgrade("SequenceStar", {}).type == "SequenceWithMemory"
    parallel = upgrade("Parallel", {"success_threshold": "2"})
    assert dict(parallel.attributes) == {"success_count": "2"}
    assert ("success_threshold", "success_count") in parallel.changes


def test_a_check_of_the_blackboard_becomes_a_precondition() -> None:
    made = upgrade("BlackboardCheckInt", {"value_A": "{x}", "value_B": "3", "return_on_mismatch": "FAILURE"})
    assert made.type == "Precondition"
    assert "x" in made.attributes["if"]


def test_what_did_not_change_stays() -> None:
    assert upgrade("Sequence", {"name": "a"}).changes == ()
