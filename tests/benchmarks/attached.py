"""An attached session: the share of a core of each of its processes while it follows a tree at 20 Hz.

The program has 600 nodes, all of which change in each tick, or none. A client hears all
events, as a page does, and the session records.
"""

from __future__ import annotations

import asyncio
import multiprocessing
from typing import TYPE_CHECKING, Final

import psutil

from tests.benchmarks.engine import NODES, body, document, warm
from tests.benchmarks.groot import HZ, SIZE
from tests.benchmarks.timing import processor_s
from tests.executor.session_client import SessionClient, manager_process
from tests.tree_gardener.debugging.hooked import free_port
from tree_gardener import Tree
from tree_gardener.groot import Groot2Publisher

if TYPE_CHECKING:
    from multiprocessing.synchronize import Event

SECONDS: Final = 20.0
WARM_S: Final = 4.0
TARGET: Final = 3.0
KINDS: Final = {
    "follower": "executor.attached.process",
    "recorder": "executor.recorder.process",
    "world": "executor.attached.world",
}


def main() -> None:
    """Prints the shares."""
    print(
        f"attached to {SIZE} nodes at {HZ:g} Hz, in percent of a core (target of the follower: {TARGET:g}):"
    )
    for what, is_still in (("none changes", True), ("all change", False)):
        shares = followed(is_still=is_still)
        print(f"  {what:20}", ", ".join(f"{kind} {share:5.2f}" for kind, share in shares.items()), flush=True)


def followed(*, is_still: bool) -> dict[str, float]:
    """The shares of the session's processes."""
    context = multiprocessing.get_context("spawn")
    port, end = free_port(), context.Event()
    program = context.Process(target=_run, args=(port, end, is_still))
    program.start()
    try:
        return asyncio.run(_measure(port))
    finally:
        end.set()
        program.join()


async def _measure(port: int) -> dict[str, float]:
    async with manager_process("--attach", f"127.0.0.1:{port}") as manager:
        client = await SessionClient(manager.ready["port"]).open(stream=False)
        await client.event("attached", lambda data: data["state"] == "following")
        await asyncio.sleep(WARM_S)  # the processes have begun, and the recording has
        session = psutil.Process(manager.pid)
        watched = {"manager": session} | {kind: _child(session, module) for kind, module in KINDS.items()}
        before = {kind: processor_s(each) for kind, each in watched.items()}
        await asyncio.sleep(SECONDS)  # the time over which is measured
        after = {kind: processor_s(each) for kind, each in watched.items()}
        ticks = len(client.named("tick"))
        assert ticks > HZ * SECONDS / 2, f"{ticks} statuses came"
        await client.close()
    return {kind: 100 * (after[kind] - before[kind]) / SECONDS for kind in watched}


def _child(session: psutil.Process, module: str) -> psutil.Process:
    return next(child for child in session.children() if module in child.cmdline())


def _run(port: int, end: Event, is_still: bool) -> None:
    """Ticks a program's tree until the end."""
    text = document(body(SIZE))
    if is_still:
        text = document(f'<Sequence><Sleep msec="100000000"/>{body(SIZE - 2)}</Sequence>')
    tree = Tree.from_xml(text, NODES)
    with Groot2Publisher(tree, port):
        warm(tree.tick_exactly_once)
        while not end.wait(1 / HZ):
            tree.tick_exactly_once()


if __name__ == "__main__":
    main()
