"""The cost of recording: processor time of a session with and without it, for each simulated second.

Both are taken in turns in one run; the ratio is what counts. `python -m tests.benchmarks recording`. Where a
camera is looked at, the pictures a second are shown too: a busy machine draws fewer, and then the rows do not
compare.
"""

from __future__ import annotations

import asyncio
import statistics
from typing import Any

import psutil

from executor.messages import Camera
from tests.benchmarks.timing import processor_s
from tests.executor.session_client import SessionClient, app_zip, manager_process, run_data

ROUNDS = 3
WATCHED_S = 20.0
PICTURES = "pictures"
EXAMPLES: tuple[tuple[str, str, dict[str, Any] | None], ...] = (
    ("laser_bump_and_go", "walled_room", None),
    ("visual_follow_person", "person_in_green", {"stream": "camera", "max_hz": 10.0, "width": 640}),
)


def main() -> None:
    """Prints every figure."""
    asyncio.run(_main())


async def _main() -> None:
    for example, universe, stream in EXAMPLES:
        rows = []
        for _ in range(ROUNDS):
            without = await cost(example, universe, stream, "--no-recording")
            rows.append((without, await cost(example, universe, stream)))
        print(f"{example}{', one camera at 10 Hz' if stream else ''}: % of a core, medians of {ROUNDS}")
        for kind in ("world", "application", "manager", "recorder"):
            show(kind, *(statistics.median(row[i].get(kind, 0.0) for row in rows) for i in (0, 1)))
        pictures = [statistics.median(row[i].pop(PICTURES) for row in rows) for i in (0, 1)]
        show("all", *(statistics.median(sum(row[i].values()) for row in rows) for i in (0, 1)))
        each = ", ".join(f"{sum(b.values()) - sum(a.values()):+.2f}" for a, b in rows)
        print(f"  of each round: {each}; pictures a second: {pictures[0]:.1f} and {pictures[1]:.1f}")


def show(what: str, without: float, recorded: float) -> None:
    """Prints one row."""
    print(f"  {what:12} {without:6.2f} without, {recorded:6.2f} recorded, {recorded - without:+6.2f}")


async def cost(example: str, universe: str, stream: dict[str, Any] | None, *options: str) -> dict[str, float]:
    """Returns the processor time of each process of a session, in % of a core."""
    async with manager_process(*options) as process:
        client = await SessionClient(process.ready["port"]).open()
        if stream is not None:
            await client.ask("subscribe", stream)
        await client.ask("run", run_data(app_zip(example), universe))
        await asyncio.sleep(3.0)
        manager = psutil.Process(process.pid)
        before = {p.pid: processor_s(p) for p in (manager, *manager.children())}
        seen = _pictures(client)
        await asyncio.sleep(WATCHED_S)
        spent: dict[str, float] = {}
        for one in (manager, *manager.children()):
            if one.pid in before:
                spent[_kind(one)] = 100 * (processor_s(one) - before[one.pid]) / WATCHED_S
        spent[PICTURES] = (_pictures(client) - seen) / WATCHED_S
        await client.close()
    return spent


def _pictures(client: SessionClient) -> int:
    return sum(isinstance(frame, Camera) for _, frame in client.frames)


def _kind(process: psutil.Process) -> str:
    command = " ".join(process.cmdline())
    kinds = ("world", "application", "recorder")
    return next((kind for kind in kinds if f"executor.{kind}.process" in command), "manager")
