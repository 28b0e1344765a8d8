"""Nav2's nodes as data."""

from __future__ import annotations

from tree_gardener.nav2_library import source_of, table


def test_a_node_has_its_source_and_others_have_none() -> None:
    source = source_of("WouldAControllerRecoveryHelp")
    assert source is not None
    assert "class WouldAControllerRecoveryHelp(" in source
    assert source_of("Sequence") is None
    assert source_of("../catalog") is None


def test_the_table_has_all_81_nodes() -> None:
    assert len(table()) == 81
    assert table()["RateController"]["ports"][0]["default"] == "10.0"
