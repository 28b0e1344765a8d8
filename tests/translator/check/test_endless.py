"""Loops that spin within one tick: those that are reported do so in the engine, those that are not do not."""

from __future__ import annotations

import signal

import pytest

from tests.translator.check.finding import find, findings
from translator import from_xml
from translator.check.endless import check_endless_loops
from tree_gardener import Tree

ENDLESS_S = 0.3


class EndlessError(Exception):
    """The tick did not end."""


def spins(body):
    """Whether one call of `tick_once` does not end."""

    def stop(*_):
        raise EndlessError

    tree = Tree.from_xml(f'<root BTCPP_format="4"><BehaviorTree ID="A">{body}</BehaviorTree></root>', {})
    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, ENDLESS_S)
    try:
        tree.tick_once()
    except EndlessError:
        return True
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
    return False


OK, NO, WAIT = "<AlwaysSuccess/>", "<AlwaysFailure/>", '<Sleep msec="1000"/>'
YIELDS = f"<AsyncSequence>{OK}{OK}</AsyncSequence>"


def repeat(inner):
    return f'<Repeat num_cycles="-1">{inner}</Repeat>'


@pytest.mark.parametrize(
    ("code", "body"),
    [
        ("BT0120", repeat(OK)),
        ("BT0120", repeat(f"<Sequence>{OK}{OK}</Sequence>")),
        ("BT0120", repeat(YIELDS)),
        ("BT0120", f'<RetryUntilSuccessful num_attempts="-1">{NO}</RetryUntilSuccessful>'),
        ("BT0120", f"<ParallelAll>{repeat(OK)}{WAIT}</ParallelAll>"),
        ("BT0125", f"<ReactiveSequence>{YIELDS}{OK}<Repeat num_cycles='2'>{OK}</Repeat></ReactiveSequence>"),
    ],
)
def test_found_and_true(code, body):
    project = from_xml(f'<root BTCPP_format="4"><BehaviorTree ID="A">{body}</BehaviorTree></root>')
    found = find(check_endless_loops, project, code)
    assert len(found.path) >= 2
    assert spins(body)


@pytest.mark.parametrize(
    "body",
    [
        repeat(WAIT),
        repeat(f"<Sequence>{OK}{WAIT}</Sequence>"),
        repeat(NO),
        f'<Repeat num_cycles="9">{OK}</Repeat>',
        f"<KeepRunningUntilFailure>{YIELDS}</KeepRunningUntilFailure>",
        repeat(f"<KeepRunningUntilFailure>{OK}</KeepRunningUntilFailure>"),
        f'<RetryUntilSuccessful num_attempts="-1">{OK}</RetryUntilSuccessful>',
        f"<ReactiveSequence>{YIELDS}{OK}</ReactiveSequence>",
    ],
)
def test_not_found_and_true(body):
    project = from_xml(f'<root BTCPP_format="4"><BehaviorTree ID="A">{body}</BehaviorTree></root>')
    assert findings(check_endless_loops, project) == []
    assert not spins(body)


def test_a_disabled_loop_does_not_spin(make_project):
    nodes = {
        "n1": {"type": "Repeat", "ports": {"num_cycles": "-1"}, "children": ["a"], "disabled": True},
        "a": {"type": "AlwaysSuccess"},
    }
    assert findings(check_endless_loops, make_project(nodes)) == []
