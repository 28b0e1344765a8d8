"""The benchmark measures what it says: the same trees, in all engines, to the same end."""

from __future__ import annotations

import pytest

from tests.benchmarks import debugger, engine, timing
from tree_gardener import Tree


@pytest.fixture(autouse=True)
def short_measurements(monkeypatch: pytest.MonkeyPatch) -> None:
    """Replaces the time of a measurement: exact figures do not matter here."""
    monkeypatch.setattr(timing, "LEAST_S", 0.001)


def test_its_trees_have_the_size_asked_for_and_run_alike() -> None:
    for size in (10, 100, 1_000):
        for last in ("Succeed", "Run"):
            xml = engine.body(size, last=last)
            tree = Tree.from_xml(engine.document(xml), engine.NODES)
            assert abs(len(tree.nodes) - size) <= size * 0.02
            plain = engine.stock(tree.nodes[0])
            plain.tick_once()
            ours = tree.tick_exactly_once().name
            assert ours == plain.status.name == engine.reference(xml).tick_exactly_once().name


def test_rows_can_be_printed() -> None:
    for row in engine.rows((10,), rounds=1):
        assert row.what in str(row)
        assert row.ours > 0


def test_rows_of_uses_can_be_printed() -> None:
    for row in engine.use_rows(4, rounds=1):
        assert row.what in str(row)
        assert row.bare > 0


def test_rows_of_scripts_can_be_printed() -> None:
    for row in engine.script_rows(4, rounds=1):
        assert row.what in str(row)
        assert row.ours > 0


def test_rows_of_the_debugger_can_be_printed() -> None:
    for row in debugger.rows(20, 5, rounds=1):
        assert row.what in str(row)
        assert row.step > 0
        assert row.results > 0
