"""One tick back with real processes, also at a line of Python; and the way back after a change by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.executor.application.python.test_debugger import ADDS, FILE, PROGRAM, Debugger
from tests.executor.exact.exact_runs import hashing_app
from tests.executor.exact.test_going_back import hashes, stepped
from tests.executor.exact.test_process import exact, ready
from tests.executor.warm import warm_session

if TYPE_CHECKING:
    from tests.executor.session_client import SessionClient

pytestmark = pytest.mark.simulation

FORWARD = {"tree_id": "MainTree", "node_id": "n6"}


def ticks(client: SessionClient, after: int) -> list[int]:
    return [each["n"] for each in client.named("tick", after)]


async def back(client: SessionClient) -> int:
    """Takes the run one tick back; returns the number of the last tick then."""
    at = len(client.events)
    assert await client.ask("tick_back") == "ack"
    assert client.state == "paused"
    assert client.named("differs") == []
    return ticks(client, at)[-1]


async def test_a_paused_run_goes_back_tick_by_tick_and_makes_them_again_as_they_were() -> None:
    async with warm_session() as (_, client):
        at = await ready(client, exact(hashing_app()))
        first = await stepped(client, at, 30)  # three single ticks
        last = max(ticks(client, at))
        at = len(client.events)
        for number in range(1, 6):
            assert await back(client) == last - number
        assert len(client.named("repeatable_runs")[-1]["runs"]) == 2, "the run, and one branch of it"
        at = len(client.events)
        for _ in range(5):
            assert await client.ask("step") == "ack"
        again = hashes(client, at)
        assert max(ticks(client, at)) == last
        assert first.items() <= again.items()
        assert await client.ask("disconnect") == "ack"


async def test_at_a_breakpoint_it_leads_to_the_tick_before_and_at_last_to_the_begin() -> None:
    async with warm_session() as (_, client):
        assert await client.ask("set_breakpoints", {"breakpoints": [FORWARD]}) == "ack"
        at = len(client.events)
        assert await client.ask("run", exact(hashing_app())) == "ack"
        for number in (1, 2, 3, 4):
            await client.event("held", lambda d, n=number: d["tick"] == n, after=at)
            await client.comes_to("held")
            if number < 4:
                assert await client.ask("continue_run") == "ack"
        assert await back(client) == 2
        at = len(client.events)
        assert await client.ask("resume") == "ack"  # it is held where it was the first time
        await client.event("held", lambda d: d["tick"] == 3, after=at)
        await client.comes_to("held")
        assert await back(client) == 1
        assert await back(client) == 0
        refused = await client.ask("tick_back")
        assert refused["code"] == "first_tick"
        assert client.state == "paused"
        at = len(client.events)
        assert await client.ask("step") == "ack"
        await client.event("held", lambda d: d["tick"] == 1, after=at)
        await client.comes_to("held")
        assert (await client.ask("tick_back"))["code"] == "first_tick"
        assert client.state == "held"
        assert await client.ask("disconnect") == "ack"


async def held_in_python(client: SessionClient, condition: str) -> tuple[Debugger, dict[str, Any]]:
    """Runs a program up to a line; returns its debugger and the stop."""
    await ready(client, exact(PROGRAM))
    debugger = Debugger(client)
    await debugger.ask("initialize")
    await debugger.configure({"line": ADDS, "condition": condition})
    stop = await debugger.event("stopped")
    await client.comes_to("held")
    return debugger, stop


async def test_a_program_at_a_line_of_python_goes_back_and_its_debugger_connects_again() -> None:
    async with warm_session() as (_, client):
        await held_in_python(client, "self.n == 40")  # in tick 41
        at = len(client.events)
        assert await back(client) == 39, "the session knew of all ticks that had ended"
        debugger = Debugger(client)
        debugger.seq = 100
        await debugger.event("terminated", at)
        await debugger.configure({"line": ADDS, "condition": "self.n == 40"}, after=at)
        at = len(client.events)
        assert await client.ask("resume") == "ack"
        await debugger.event("stopped", at)
        await client.comes_to("held")
        assert await back(client) == 39, "it is held in the same tick again"
        assert await client.ask("disconnect") == "ack"


async def test_after_a_change_by_hand_the_run_goes_back_only_to_before_it() -> None:
    async with warm_session() as (_, client):
        debugger, stop = await held_in_python(client, "self.n == 40")
        frame = await debugger.top(stop)
        this = (await debugger.locals(frame))["self"]["variablesReference"]
        await debugger.ask("variables", variablesReference=this)
        await debugger.ask("setVariable", name="n", value="500", variablesReference=this)
        await debugger.ask("setBreakpoints", source={"path": FILE}, breakpoints=[])
        at = len(client.events)
        await debugger.ask("continue", threadId=stop["threadId"])
        await client.event("tick", lambda d: d["n"] > 60, after=at)
        assert await client.ask("pause") == "ack"
        refused = await debugger.message_of("evaluate", expression="1 + 1")
        assert refused["success"] is False
        assert "not held" in refused["message"]

        known = client.named("repeatable_runs")[-1]
        (by_hand_s,) = known["by_hand"].values()
        assert by_hand_s == pytest.approx(2.0, abs=0.2)
        run = known["runs"][-1]
        seeds = {"job": "a1", "run": run, "t": by_hand_s + 0.5, "seeds": [2], "duration_s": 1.0}
        source = {"job": "a2", "run": run, "t": by_hand_s + 0.5}
        for command, data in (
            ("go_back", {}),
            ("go_back", {"t": by_hand_s}),
            ("try_seeds", seeds),
            ("source_of_tick", source),
            ("tick_back", {}),
        ):
            refused = await client.ask(command, data)
            assert refused["code"] == "changed_by_hand", command
            assert client.state == "paused"

        at = len(client.events)
        assert await client.ask("go_back", {"run": run, "t": by_hand_s - 0.001}) == "ack"
        assert ticks(client, at)[-1] <= 40, "tick 41 is the changed one"
        assert client.named("differs") == []
        assert client.named("repeatable_runs")[-1]["by_hand"] == {run: by_hand_s}
        assert await back(client) <= 39
        assert await client.ask("disconnect") == "ack"
