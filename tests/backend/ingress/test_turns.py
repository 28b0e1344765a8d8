"""Requests of an owner over their share run one after the other, each after its wait."""

from __future__ import annotations

import asyncio

import pytest

from backend.core.processes.budgets import Budgets
from backend.ingress import turns as module
from backend.ingress.turns import Turns


class Clock:
    now_s = 100.0

    def __call__(self):
        return self.now_s


class Settings:
    is_team = True


@pytest.fixture
def turns(monkeypatch):
    monkeypatch.setattr(module, "environment", lambda: Settings)
    made = Turns(Budgets(share=0.5, burst_s=0.1, clock=Clock()))
    made.spend("ann", 0.001)
    return made


async def most_at_once(turns, owner, requests):
    at_work, most = 0, 0

    async def ask():
        nonlocal at_work, most
        async with turns.turn(owner):
            at_work += 1
            most = max(most, at_work)
            for _ in range(3):
                await asyncio.sleep(0)
            at_work -= 1

    await asyncio.gather(*(ask() for _ in range(requests)))
    return most


async def test_an_owner_within_their_share_asks_for_much_at_once(turns):
    turns.spend("eve", 0.1)
    assert await most_at_once(turns, "eve", 5) == 5


async def test_an_owner_over_their_share_gets_one_thing_after_the_other(turns):
    turns.spend("eve", 0.105)
    assert await most_at_once(turns, "eve", 5) == 1
    assert await most_at_once(turns, "ann", 5) == 5


async def test_a_rest_is_waited_for(turns, monkeypatch):
    rests, sleep = [], asyncio.sleep

    async def told(seconds):
        rests.append(seconds)
        await sleep(0)

    turns.spend("eve", 0.2)
    monkeypatch.setattr(asyncio, "sleep", told)
    async with turns.turn("eve"):
        pass
    assert rests == [pytest.approx(0.2)]


async def test_a_server_of_one_user_waits_for_nobody(turns, monkeypatch):
    monkeypatch.setattr(Settings, "is_team", False)
    turns.spend("eve", 5.0)
    assert await most_at_once(turns, "eve", 5) == 5


async def test_a_request_that_is_cancelled_leaves_the_queue(turns):
    turns.spend("eve", 0.2)

    async def ask():
        async with turns.turn("eve"):
            raise AssertionError("it was cancelled before")

    asking = asyncio.ensure_future(ask())
    await asyncio.sleep(0)
    asking.cancel()
    with pytest.raises(asyncio.CancelledError):
        await asking
    turns.spend("eve", -1.0)
    assert await most_at_once(turns, "eve", 5) == 5
