"""The report of a run."""

from __future__ import annotations

from executor.headless.report import WALL_FIELDS, NodeCount, Report, quantiles


def test_the_parts_that_depend_on_the_machine_can_be_left_out() -> None:
    report = Report(ticks=3, wall_time_s=2.0, nodes=[NodeCount("A")])
    assert set(report.to_json()) - set(report.without_wall_times()) == set(WALL_FIELDS)
    assert report.to_json()["nodes"] == [{"path": "A", "ticks": 0, "success": 0, "failure": 0, "running": 0}]


def test_quantiles_are_in_milliseconds() -> None:
    assert quantiles([]) == {"p50": 0.0, "p95": 0.0, "max": 0.0}
    assert quantiles([n / 1000 for n in range(1, 101)]) == {"p50": 50.0, "p95": 95.0, "max": 100.0}
