"""The profile of a run: switched between ticks, reported in sums, recorded in parts."""

from __future__ import annotations

from typing import Any

import py_trees
import pytest

from executor import child_messages, messages
from executor.application.profiling import REPORT_S, ApplicationProfile
from executor.messages import SampledStack, SetProfile
from tree_gardener import Tree

TREE = (
    "<root BTCPP_format='4'><BehaviorTree ID='M'><Sequence name='s'><AlwaysSuccess name='x'/>"
    "<Act name='y'/></Sequence></BehaviorTree></root>"
)


class Act(py_trees.behaviour.Behaviour):
    """Is RUNNING, and calls `during` within its tick."""

    during: Any = staticmethod(lambda: None)

    def update(self):
        type(self).during()
        return py_trees.common.Status.RUNNING


class Samples:
    """A sampler that has seen one stack."""

    def __init__(self, uid, current):
        self.uid = uid
        self.current = current
        self.samples = 4
        self.is_closed = False

    def stacks(self):
        return [SampledStack(["update (actions/Act.py:3)"], 4)]

    def close(self):
        self.is_closed = True


class Bench:
    """A tree with its profile; `passes` moves real time and lets it report."""

    def __init__(self):
        self.act = type("Act", (Act,), {})
        self.tree = Tree.from_xml(TREE, {"Act": self.act})
        self.tree.setup()
        self.sent: list[child_messages.Profile] = []
        self.recorded: list[tuple[int, list[int]]] = []
        self.samplers: list[Samples] = []
        self.now_s = 0.0
        self.profile = ApplicationProfile(
            self.tree,
            self.sent.append,
            lambda ticks, times: self.recorded.append((ticks, [time.calls for time in times])),
            sampler=self.sample,
            clock=lambda: self.now_s,
        )

    def sample(self, uid, current):
        self.samplers.append(Samples(uid, current))
        return self.samplers[-1]

    def passes(self, ticks, duration_s=REPORT_S):
        self.now_s += duration_s
        for _ in range(ticks):
            self.tree.tick_once()
        self.profile.between_ticks()


@pytest.fixture
def bench():
    return Bench()


def test_nothing_is_measured_before_it_is_asked_for(bench):
    entries = [child.entry() for child in bench.tree.nodes[0].children]
    bench.passes(3)
    assert bench.sent == bench.recorded == []
    assert [child.entry() for child in bench.tree.nodes[0].children] == entries


def test_reports_are_sums_and_records_are_parts(bench):
    assert bench.profile.obey(SetProfile()) is None
    bench.passes(0)
    bench.passes(2)
    bench.passes(3)
    assert [(each.on, each.ticks) for each in bench.sent] == [(True, 0), (True, 2), (True, 5)]
    assert [each.calls for each in bench.sent[-1].nodes] == [5, 1, 5]
    assert bench.recorded == [(2, [2, 1, 2]), (3, [3, 3])]
    root = bench.sent[-1].nodes[0]
    assert bench.sent[-1].tick_ms == root.total_ms >= root.self_ms > 0


def test_reports_come_twice_a_second_and_only_after_ticks(bench):
    bench.profile.obey(SetProfile())
    bench.passes(0)
    bench.passes(2, REPORT_S / 2)
    assert len(bench.sent) == 1
    bench.passes(2, REPORT_S / 2)
    bench.passes(0)
    bench.passes(0)
    assert [each.ticks for each in bench.sent] == [0, 4]


def test_the_last_report_says_that_it_is_off_and_a_new_one_begins_again(bench):
    bench.profile.obey(SetProfile())
    bench.passes(0)
    bench.passes(2)
    bench.profile.obey(SetProfile(on=False))
    bench.passes(1)
    assert (bench.sent[-1].on, bench.sent[-1].ticks) == (False, 3)
    bench.passes(4)
    assert bench.recorded == [(2, [2, 1, 2]), (1, [1, 1])]
    bench.profile.obey(SetProfile())
    bench.passes(0)
    bench.passes(1)
    assert (bench.sent[-1].on, bench.sent[-1].ticks) == (True, 1)
    bench.profile.close()
    assert not bench.sent[-1].on


def test_within_a_tick_nothing_is_switched(bench):
    bench.act.during = staticmethod(
        lambda: (bench.profile.obey(SetProfile()), bench.profile.between_ticks(), bench.profile.close())
    )
    bench.tree.tick_once()
    assert bench.sent == []
    bench.act.during = staticmethod(lambda: None)
    bench.passes(0)
    assert len(bench.sent) == 1


def test_a_hold_is_no_part_of_the_times(bench):
    bench.profile.leave_out(1.0)  # nothing is measured yet
    bench.act.during = staticmethod(lambda: bench.profile.leave_out(3600.0))
    bench.profile.obey(SetProfile())
    bench.passes(0)
    bench.passes(1)
    assert -3.7e6 < bench.sent[-1].nodes[0].total_ms < -3.5e6  # no real time passed in this hold


def test_a_leaf_of_the_project_is_sampled(bench):
    y = bench.tree.nodes[2]
    assert bench.profile.obey(SetProfile(sample=3, path=y.path)) is None
    bench.passes(0)
    bench.passes(1)
    last = bench.sent[-1]
    assert (last.sample, last.samples, last.stacks[0].samples) == (3, 4, 4)
    bench.tree.current[0] = 7
    assert bench.samplers[0].current() == 7
    bench.profile.obey(SetProfile())
    bench.passes(0)
    assert bench.samplers[0].is_closed
    assert bench.sent[-1].sample is None


@pytest.mark.parametrize(
    ("uid", "path", "code"),
    [(9, "y", "unknown_node"), (3, "z", "unknown_node"), (2, "x", "no_python"), (1, "s", "no_python")],
)
def test_another_leaf_is_refused_and_nothing_changes(bench, uid, path, code):
    refused = bench.profile.obey(SetProfile(sample=uid, path=path))
    assert isinstance(refused, messages.Error)
    assert refused.code == code
    assert refused.hint
    bench.passes(2)
    assert bench.sent == []


def test_another_tree_is_measured_from_its_own_begin(bench):
    bench.profile.obey(SetProfile(on=True))
    bench.profile.between_ticks()
    bench.tree.tick_exactly_once()
    fresh = Tree.from_xml(TREE, {"Act": bench.act})
    bench.profile.follow(fresh)
    assert [report.on for report in bench.sent] == [True, False, True]
    fresh.tick_exactly_once()
    bench.now_s += REPORT_S
    bench.profile.between_ticks()
    assert bench.sent[-1].ticks == 1
