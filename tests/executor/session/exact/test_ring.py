"""The ring of snapshots: bounds that always hold, and gaps that are short where there is room."""

from __future__ import annotations

import itertools
import random
from dataclasses import replace

import pytest

from executor.session.exact.ring import CEILING_BYTES, MOST, MOST_TIPS, Kept, surplus
from tests.budget import count


def run_for(duration_s: float, share: float, spacing_s: float = 0.5, run: int = 0) -> list[Kept]:
    """Returns the snapshots of a run that takes a share of real time, made at a spacing of work."""
    made = int(duration_s * share / spacing_s) + 1
    return [Kept((run, at), run, at * spacing_s / share, at * spacing_s, 6 << 20) for at in range(made)]


def kept_of(made: list[Kept], *, draws: bool = False, ceiling_bytes: int = CEILING_BYTES) -> list[Kept]:
    """Returns what is left if each is added in turn."""
    left: list[Kept] = []
    for each in made:
        left.append(each)
        dropped = surplus(left, draws=draws, ceiling_bytes=ceiling_bytes)
        left = [one for one in left if one not in dropped]
        assert len([one for one in left if not one.is_tip]) <= MOST
        assert sum(one.size_bytes for one in left if not one.is_tip) <= ceiling_bytes
    return left


def longest_gap(left: list[Kept], from_s: float, to_s: float) -> float:
    pairs = itertools.pairwise(left)
    return max((b.cost_s - a.cost_s for a, b in pairs if from_s < b.t <= to_s), default=0.0)


@pytest.mark.parametrize(
    ("draws", "share", "spacing_s", "recent_s", "old_s"),
    [(False, 1 / 25, 0.5, 0.5, 4.0), (False, 1 / 41, 0.5, 0.5, 4.0), (True, 1 / 8, 1.5, 1.5, 9.0)],
)
def test_going_back_is_short_for_ten_minutes(
    draws: bool, share: float, spacing_s: float, recent_s: float, old_s: float
) -> None:
    left = kept_of(run_for(1200, share, spacing_s), draws=draws)
    last = left[-1].t
    assert longest_gap(left, last - 60, last) <= recent_s + 1e-9
    assert longest_gap(left, last - 600 + 60, last - 60) <= old_s + 1e-9
    assert left[0].t == 0


def test_what_is_not_needed_is_not_kept() -> None:
    left = kept_of(run_for(3600, 1 / 41))
    assert len(left) <= 16


def test_bounds_hold_for_any_snapshots_and_the_present_stays() -> None:
    for seed in range(count("rings")):
        chance = random.Random(seed)  # noqa: S311 - a test
        made, t, cost = [], 0.0, 0.0
        for number in range(chance.randrange(1, 120)):
            t += chance.expovariate(0.2)
            cost += chance.expovariate(1.0)
            run = number // 25
            size = chance.randrange(0, 40 << 20)
            made.append(Kept((run, number), run, t, cost, size, is_tip=chance.random() < 0.1))
        ceiling = chance.choice([64 << 20, CEILING_BYTES])
        left = kept_of(made, draws=chance.random() < 0.5, ceiling_bytes=ceiling)
        assert sum(each.is_tip for each in left) <= MOST_TIPS
        assert made[-1] in left


def test_without_memory_nothing_is_kept_but_tips() -> None:
    made = run_for(60, 1 / 25)
    tip = replace(made[0], key=(9, 9), is_tip=True)
    assert {each.key for each in surplus([*made, tip], ceiling_bytes=0)} == {each.key for each in made}


def test_earlier_runs_give_way_first() -> None:
    first, second = run_for(60, 0.5, run=0), run_for(60, 0.5, run=1)
    left = [each for each in first + second if each not in surplus(first + second)]
    assert len(left) <= MOST
    gone = [each for each in second if each not in left]
    assert gone == [] or not [each for each in left if each.run == 0]
