"""Looks of the Python debugger at the values of `hostile_values`, and their bounds."""

from __future__ import annotations

import asyncio
import signal
import threading
from pathlib import Path
from typing import Any

import pytest

from executor.application.python.looks import EndlessLookError, look
from tests.executor.application.python.test_debugger import Debugger
from tests.executor.application.real_application import app, run_data, session
from tests.fakes import hostile_values
from tests.fakes.hostile_values import VALUES

ACTION = """
import py_trees


class Asks:
    def __len__(self):
        while True:
            pass

    @property
    def endless(self):
        while True:
            pass

    @property
    def raises(self):
        raise SystemExit("no value")

    @property
    def __dict__(self):
        raise ValueError("no attributes")


class Swallows:
    def __repr__(self):
        while True:
            try:
                while True:
                    pass
            except Exception:
                pass


class Act(py_trees.behaviour.Behaviour):
    n = 0

    def update(self):
        masked, asks, endless, swallows, plain = Masked(), Asks(), Endless(), Swallows(), 7
        several = [Endless(), Endless(), Endless()]
        self.n += 1
        return py_trees.common.Status.RUNNING
"""
SOURCE = Path(hostile_values.__file__).read_text() + ACTION
LINE = SOURCE.split("\n").index("        self.n += 1") + 1
LOCALS = {"asks": "Asks", "endless": "Endless", "masked": "Masked", "swallows": "Swallows", "plain": "int"}


def turn() -> None:
    while True:
        pass


def test_a_block_that_does_not_end_is_ended_and_one_that_ends_is_not() -> None:
    with pytest.raises(EndlessLookError), look(0.01):
        turn()
    with look(600):
        pass
    ended = 0
    with look(0.01, 0.01):
        while ended < 3:
            try:
                turn()
            except EndlessLookError:
                ended += 1


def test_a_look_within_a_look_has_the_time_of_the_outer_one() -> None:
    with pytest.raises(EndlessLookError), look(0.01), look(600):
        turn()


def test_afterwards_the_signal_and_the_timer_are_the_users_again() -> None:
    got: list[int] = []
    before = signal.signal(signal.SIGALRM, lambda number, _: got.append(number))
    try:
        signal.setitimer(signal.ITIMER_REAL, 500.0)
        with pytest.raises(EndlessLookError), look(0.01):
            turn()
        assert 400 < signal.getitimer(signal.ITIMER_REAL)[0] <= 500
        signal.raise_signal(signal.SIGALRM)
        assert got == [signal.SIGALRM]
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def test_looks_of_other_threads_are_not_bounded_and_change_nothing() -> None:
    handlers = []

    def elsewhere() -> None:
        with look(0.0):
            handlers.append(signal.getsignal(signal.SIGALRM))

    before = signal.getsignal(signal.SIGALRM)
    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert handlers == [before]


async def _looked(debugger: Debugger, frame: dict[str, Any], text: str) -> list[dict[str, Any]]:
    """Looks at a value and its parts as a watch does; returns all that is shown."""
    found = await debugger.ask("evaluate", expression=text, frameId=frame["id"], context="watch")
    parts: list[dict[str, Any]] = []
    if found["variablesReference"]:
        parts = (await debugger.ask("variables", variablesReference=found["variablesReference"]))["variables"]
    return [{"name": text, "value": found["result"], **found}, *parts]


@pytest.mark.timeout(600)
async def test_any_value_of_a_user_can_be_looked_at_and_the_run_continues() -> None:
    async with session() as client:
        debugger = Debugger(client)
        await debugger.ask("initialize")
        run = asyncio.create_task(client.ask("run", run_data(app(SOURCE, **{"actions__Act.py": SOURCE}))))
        await debugger.event("initialized")
        await debugger.ask("setBreakpoints", source={"path": "actions/Act.py"}, breakpoints=[{"line": LINE}])
        await debugger.ask("configurationDone")
        assert await run == "ack"
        stop = await debugger.event("stopped")
        frame = await debugger.top(stop)

        found = await debugger.locals(frame)
        assert {name: found[name]["type"] for name in LOCALS} == LOCALS
        assert found["plain"]["value"] == "7"
        for name in ("endless", "swallows"):
            assert found[name]["value"].startswith(("Unable to get repr for <class", "<"))
        for name in LOCALS:
            shown = await _looked(debugger, frame, name)
            assert not any("Traceback" in each["value"] for each in shown), shown
        for number in range(0, len(VALUES), 7):  # all of them take minutes
            shown = await _looked(debugger, frame, f"VALUES[{number}]")
            assert not any("Traceback" in each["value"] for each in shown), (number, shown)
        several = await _looked(debugger, frame, "several")  # its parts take longer than one look
        assert [part["name"] for part in several[-4:]] == ["0", "1", "2", "len()"]
        refused = await debugger.message_of(
            "evaluate", expression="repr(endless)", frameId=frame["id"], context="watch"
        )
        assert not refused["success"]
        assert "does not end" in refused["message"]
        assert client.state == "held"
        assert (debugger.events("continued"), len(debugger.events("stopped"))) == ([], 1)

        at = len(client.events)
        await debugger.ask("disconnect")
        await client.event("tick", lambda d: d["n"] > 3, after=at)
        assert client.named("fault") == []
