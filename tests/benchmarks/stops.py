"""The debugger without a page: the time from a stop in the program until a client has its message.

`debugger_page` begins where this ends, so that the sum is the time from a stop to the page. The program
prints its clock in the line before the stop; client and program have the same clock.
"""

from __future__ import annotations

import asyncio
import statistics
from typing import TYPE_CHECKING, Any, Final

from tests.executor.session_client import ROOT, SessionClient, app_zip, manager_process, run_data

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

ROUNDS: Final = 30
ACTION: Final = "CheckObstacle"
FILE: Final = f"actions/{ACTION}.py"
BLOCK: Final = {"tree_id": "MainTree", "node_id": "n4", "when": "after"}
BEGIN: Final = "    def update(self):\n"
CLOCK: Final = "        print('at', __import__('time').monotonic())\n"


def main() -> None:
    """Prints the times."""
    for what, stops in (("a block", of_a_block), ("a line of Python", of_a_line)):
        found = asyncio.run(timed(stops))
        print(
            f"a stop at {what} until a client has its message: median {statistics.median(found):5.1f} ms, "
            f"largest {max(found):5.1f} ms",
            flush=True,
        )


async def timed(stops: Callable[[SessionClient], Awaitable[list[float]]]) -> list[float]:
    """Runs the example with a clock in its action; returns the ms of each stop."""
    source = (ROOT / "examples" / "laser_bump_and_go" / FILE).read_text()
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open(stream=False)
        data = run_data(app_zip(**{ACTION: source.replace(BEGIN, BEGIN + CLOCK)}))
        assert await client.ask("run", data) == "ack"
        await client.event("tick", lambda tick: tick["n"] > 20)
        found = await stops(client)
        await client.close()
    return found


async def of_a_block(client: SessionClient) -> list[float]:
    """Stops after the tick of a block, which prints its clock last."""
    at = len(client.events)
    assert await client.ask("set_breakpoints", {"breakpoints": [BLOCK]}) == "ack"
    found = []
    for _ in range(ROUNDS):
        held = await client.event("held", after=at)
        found.append(await since_print(client, held))
        at = len(client.events)
        assert await client.ask("continue_run") == "ack"
    return found


async def of_a_line(client: SessionClient) -> list[float]:
    """Stops at the line after the one that prints."""
    source = (ROOT / "examples" / "laser_bump_and_go" / FILE).read_text()
    line = source[: source.index(BEGIN)].count("\n") + 3
    await ask(client, 1, "initialize")
    await client.event("dap", is_event("initialized"))
    at = len(client.events)
    await ask(client, 2, "setBreakpoints", source={"path": FILE}, breakpoints=[{"line": line}])
    await ask(client, 3, "configurationDone")
    found = []
    for number in range(ROUNDS):
        stop = await client.event("dap", is_event("stopped"), after=at)
        found.append(await since_print(client, stop))
        at = len(client.events)
        await ask(client, 4 + number, "continue", threadId=stop["data"]["message"]["body"]["threadId"])
    return found[1:]  # the first one waits for code that debugpy loads


async def ask(client: SessionClient, seq: int, command: str, **arguments: Any) -> None:
    """Sends a request of the Debug Adapter Protocol."""
    message = {"seq": seq, "type": "request", "command": command, "arguments": arguments}
    assert await client.ask("dap", {"message": message}) == "ack"


def is_event(name: str) -> Callable[[dict[str, Any]], bool]:
    """Finds an event of the protocol."""
    return lambda data: data["message"].get("event") == name


async def since_print(client: SessionClient, event: dict[str, Any]) -> float:
    """Returns the ms from the last clock that was printed before an event until it came."""
    await asyncio.sleep(0.3)  # lines of the console come in batches
    return 1000 * (float(event["at"]) - clocks(client)[-1])


def clocks(client: SessionClient) -> list[float]:
    """Returns all clocks that the program printed, in s."""
    words = [log["text"].split() for log in client.named("log") if log["source"] == "action"]
    return [float(row[1]) for row in words if len(row) == 2 and row[0] == "at"]


if __name__ == "__main__":
    main()
