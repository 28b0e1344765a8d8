"""The profile of a run in the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.headless import profiling
from executor.headless.profiling import EVERY_S, RunProfile, lines_of
from executor.headless.report import ProfileRow
from tree_gardener import Tree

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pytest

    from tree_gardener.profiling import NodeTime

TREE = (
    "<root BTCPP_format='4'><BehaviorTree ID='M'><Sequence name='s'><AlwaysSuccess name='x'/>"
    "<AlwaysFailure name='y'/><AlwaysSuccess name='z'/></Sequence></BehaviorTree></root>"
)


def test_a_run_is_measured_and_its_parts_are_recorded() -> None:
    tree = Tree.from_xml(TREE)
    recorded: list[tuple[int, int]] = []

    def record(ticks: int, times: Sequence[NodeTime]) -> None:
        recorded.append((ticks, sum(time.calls for time in times)))

    tree.tick_once()
    profile = RunProfile(tree, record)
    for tick in range(1, 6):
        tree.tick_once()
        profile.look(tick * EVERY_S / 2)
    assert recorded == [(2, 6), (2, 6)]
    rows = profile.end()
    assert recorded[2:] == [(1, 3)]
    assert [(row.path, row.calls) for row in rows] == [("s", 5), ("x", 5), ("y", 5)]
    assert rows[0].total_ms >= rows[0].self_ms > 0
    tree.tick_once()
    assert profile.end() == rows


def test_nothing_need_be_recorded() -> None:
    tree = Tree.from_xml(TREE)
    profile = RunProfile(tree, None)
    tree.tick_once()
    assert [row.calls for row in profile.end()] == [1, 1, 1]


def test_the_table_begins_with_the_slowest_node() -> None:
    rows = [
        ProfileRow("s", 4, 10.0, 1.0),
        ProfileRow("s/long name", 4, 3.0, 3.0),
        ProfileRow("z", 2, 6.0, 6.0),
    ]
    lines = list(lines_of(rows))
    assert [line.split()[0] for line in lines] == ["node", "z", "s/long", "s"]
    assert lines[1].split() == ["z", "60.0%", "6.00", "6.00", "2", "3000.0"]
    assert len({len(line) for line in lines}) == 1


def test_a_large_table_ends_with_what_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(profiling, "MOST_LINES", 2)
    lines = list(lines_of([ProfileRow(f"n{i}", 1, i, i) for i in range(5)]))
    assert lines[-1] == "and 3 more nodes with 3.00 ms of their own"
    assert len(lines) == 4


def test_a_table_of_nothing_says_so() -> None:
    assert list(lines_of([])) == ["No node was ticked, so there are no times."]
