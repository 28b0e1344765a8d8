"""The share of an owner: a burst, then a rate, and only while others use the server."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.core.processes.budgets import LONGEST_REST_S, OTHERS_S, Budgets


class Clock:
    def __init__(self):
        self.now_s = 100.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def budgets(clock):
    made = Budgets(share=0.2, burst_s=0.4, clock=clock)
    made.spend("ann", 0.001)
    return made


def test_a_burst_needs_no_rest(budgets):
    assert budgets.spend("eve", 0.4) == 0.0


def test_what_exceeds_the_burst_is_rested_for(budgets):
    budgets.spend("eve", 0.4)
    assert budgets.spend("eve", 0.1) == pytest.approx(0.1 / 0.2)
    assert budgets.rest_s("ann") == 0.0


def test_each_piece_moves_the_next_one_away(budgets):
    budgets.spend("eve", 0.4)
    rests = [budgets.spend("eve", 0.01) for _ in range(3)]
    assert rests == pytest.approx([0.05, 0.1, 0.15])


def test_a_burst_comes_back_with_time(budgets, clock):
    budgets.spend("eve", 0.4)
    clock.now_s += 1.0
    budgets.spend("ann", 0.001)
    assert budgets.spend("eve", 0.2) == 0.0
    assert budgets.spend("eve", 0.02) == pytest.approx(0.1)


def test_nobody_rests_alone(budgets, clock):
    budgets.spend("eve", 1.0)
    assert budgets.rest_s("eve") > 0
    clock.now_s += OTHERS_S + 0.1
    budgets.spend("eve", 1.0)
    assert budgets.rest_s("eve") == 0.0
    budgets.spend("ann", 0.001)
    assert budgets.rest_s("eve") > 0


def test_an_owner_alone_since_the_start_does_not_rest(clock):
    budgets = Budgets(share=0.2, burst_s=0.4, clock=clock)
    assert budgets.spend("eve", 100.0) == 0.0


def test_no_rest_is_longer_than_the_longest(budgets):
    assert budgets.spend("eve", 1000.0) == pytest.approx(LONGEST_REST_S)


def test_owners_who_used_little_are_forgotten(monkeypatch, budgets, clock):
    monkeypatch.setattr("backend.core.processes.budgets.MOST_OWNERS", 3)
    budgets.spend("eve", 2.0)
    for number in range(50):
        clock.now_s += 0.01
        budgets.spend(f"passer-by {number}", 0.0)
    assert budgets.rest_s("eve") > 0


@given(st.lists(st.tuples(st.floats(0, 1), st.floats(0, 0.1)), min_size=1, max_size=50))
def test_who_rests_as_said_uses_no_more_than_burst_and_share(pieces):
    clock = Clock()
    budgets = Budgets(share=0.2, burst_s=0.4, clock=clock)
    began_s, used_s = clock.now_s, 0.0
    for pause_s, piece_s in pieces:
        clock.now_s += pause_s
        budgets.spend("ann", 0.0)
        clock.now_s += budgets.rest_s("eve")
        budgets.spend("ann", 0.0)
        assert used_s <= 0.4 + 0.2 * (clock.now_s - began_s) + 1e-9
        budgets.spend("eve", piece_s)
        used_s += piece_s
