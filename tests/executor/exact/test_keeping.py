"""When a run makes snapshots of itself."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from executor.exact import keeping
from executor.exact.keeping import DRAWING_SPACING_S, SPACING_S, Keeping
from executor.supervision.handover import HANDOVER_VARIABLE, handover_pair

if TYPE_CHECKING:
    from collections.abc import Iterator


class Made:
    """Takes the place of forks: says what the next one returns."""

    result: Any = True
    link: Any = None

    def over(self, link: Any) -> Made:
        self.link = link
        return self

    def take(self, number: int) -> Any:
        return self.result


class Case:
    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.ours, theirs = handover_pair()
        monkeypatch.setenv(HANDOVER_VARIABLE, str(theirs.detach()))
        self.sent: list[Any] = []
        self.now_s = 0.0
        self.made = Made()
        monkeypatch.setattr(keeping, "Snapshots", self.made.over)
        self.keeping = Keeping(self.sent.append, lambda: self.now_s)
        self.reason = ""
        self.foreign = SimpleNamespace(refusal=lambda renderer: self.reason)
        monkeypatch.setattr(keeping, "Foreign", lambda: self.foreign)
        self.keeping.begin()
        self.loop: Any = SimpleNamespace(ticks=0, time_s=0.0, is_at_tick=True)
        self.keeping.is_on = True

    def is_due(self, *, draws: bool = False) -> bool:
        return self.keeping.is_due(self.loop, draws=draws)

    def take(self, **more: Any) -> Any:
        return self.keeping.take(self.loop, "", **more)


@pytest.fixture
def case(monkeypatch: pytest.MonkeyPatch) -> Iterator[Case]:
    it = Case(monkeypatch)
    yield it
    it.ours.close()
    it.made.link.close()


def test_the_first_is_due_at_once_and_others_after_some_work(case: Case) -> None:
    assert case.is_due()
    case.take()
    assert not case.is_due()
    case.loop.ticks, case.loop.time_s = 4, 0.2
    assert not case.is_due()
    case.now_s = SPACING_S
    assert case.is_due()
    assert not case.is_due(draws=True)
    case.now_s = DRAWING_SPACING_S
    assert case.is_due(draws=True)
    case.loop.is_at_tick = False
    assert not case.is_due()
    case.loop.is_at_tick = True
    case.keeping.is_on = False
    assert not case.is_due()


def test_it_says_where_the_run_is(case: Case) -> None:
    case.loop.ticks, case.loop.time_s, case.now_s = 7, 0.35, 2.0
    case.keeping.inputs, case.keeping.resets = 3, 1
    case.take(is_wanted=True)
    (taken,) = case.sent
    assert (taken.number, taken.t, taken.ticks, taken.inputs, taken.resets) == (1, 0.35, 7, 3, 1)
    assert (taken.cost_s, taken.is_wanted) == (2.0, True)


def test_a_reason_is_sent_once_and_again_on_request(case: Case) -> None:
    case.reason = "the thread “t” runs in it"
    for ticks in (0, 5):
        case.loop.ticks = ticks
        case.take()
    assert [message.reason for message in case.sent] == [case.reason]
    case.take(is_wanted=True)
    assert case.sent[-1].is_wanted


def test_a_busy_thread_is_waited_for(case: Case) -> None:
    case.made.result = False
    case.take()
    assert case.sent == []
    assert case.is_due()
    case.take(is_wanted=True)
    assert case.sent[-1].reason == keeping.BUSY


def test_without_a_manager_there_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(HANDOVER_VARIABLE, raising=False)
    alone = Keeping([].append, lambda: 0.0)
    alone.is_on = True
    loop: Any = SimpleNamespace(ticks=0, time_s=0.0, is_at_tick=True)
    assert not alone.is_due(loop, draws=False)
