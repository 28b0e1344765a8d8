"""Groot2's protocol: the cost of a publisher that nobody asks, of one with a client, and of the client.

The rival is BehaviorTree.CPP's own publisher with the same tree and the same client.
"""

from __future__ import annotations

import multiprocessing
import time
from typing import TYPE_CHECKING, Final

from tests.benchmarks.engine import NODES, STATUS, body, document, warm
from tests.benchmarks.timing import race
from tests.tree_gardener.debugging.hooked import free_port
from tree_gardener import Tree
from tree_gardener.groot import Groot2Publisher
from tree_gardener.groot.client import Groot2Client

if TYPE_CHECKING:
    from collections.abc import Callable
    from multiprocessing.synchronize import Event

    Running = tuple[Callable[[], object], object]
    Program = Callable[[int], Running]

SIZE: Final = 600
HZ: Final = 20.0
BOARD_EACH: Final = 10  # polls
SECONDS: Final = 10.0


def main() -> None:
    """Prints the costs."""
    asked, plain = unasked()
    print(
        f"tick of {SIZE} nodes, microseconds: {plain:.2f}, with a publisher that nobody asks {asked:.2f}",
        end="",
    )
    print(f" ({asked / plain:.3f}x)")
    print(f"{HZ:g} statuses a second and {HZ / BOARD_EACH:g} blackboards, in percent of a core:")
    for name, program in (("ours", our_program), ("BehaviorTree.CPP", cpp_program)):
        alone, followed, client = followed_shares(program)
        print(f"  {name:17} program {alone:5.2f} alone, {followed:5.2f} followed; client {client:5.2f}")


def unasked() -> tuple[float, float]:
    """Microseconds a tick with a publisher that nobody asks, and without one."""
    trees = [Tree.from_xml(document(body(SIZE)), NODES) for _ in range(2)]
    with Groot2Publisher(trees[0], free_port()):
        calls = [tree.tick_exactly_once for tree in trees]
        warm(*calls)
        asked, plain = race(*calls, rounds=15)
    return asked, plain


def followed_shares(program: Program) -> tuple[float, float, float]:
    """The shares of a core of a program alone and with a client, and of the client, in percent."""
    context = multiprocessing.get_context("spawn")
    shares, client = [], 0.0
    for is_followed in (False, True):
        port, end, used = free_port(), context.Event(), context.Value("d", 0.0)
        process = context.Process(target=_run, args=(program, port, end, used))
        process.start()
        begin_s = time.process_time()
        if is_followed:
            _follow(port)
            client = 100 * (time.process_time() - begin_s) / SECONDS
        else:
            time.sleep(SECONDS)
        end.set()
        process.join()
        shares.append(100 * used.value)
    return shares[0], shares[1], client


def _follow(port: int) -> None:
    with Groot2Client("127.0.0.1", port, 60.0) as client:
        scopes = client.tree().scopes
        for poll in range(round(SECONDS * HZ)):
            due_s = time.monotonic() + 1 / HZ
            client.statuses()
            if poll % BOARD_EACH == 0:
                client.blackboards(scopes)
            time.sleep(max(due_s - time.monotonic(), 0.0))


def _run(program: Program, port: int, end: Event, used: object) -> None:
    """Ticks a program's tree; writes its share of a core, since the tree was warm."""
    tick, publisher = program(port)
    warm(tick)
    begin_s, began_s = time.process_time(), time.monotonic()
    while not end.wait(1 / HZ):
        tick()
    used.value = (time.process_time() - begin_s) / (time.monotonic() - began_s)  # type: ignore[attr-defined]
    del publisher


def our_program(port: int) -> Running:
    """Our engine and publisher."""
    tree = Tree.from_xml(document(body(SIZE)), NODES)
    return tree.tick_exactly_once, Groot2Publisher(tree, port)


def cpp_program(port: int) -> Running:
    """BehaviorTree.CPP's engine and publisher, with leaves in Python as ours."""
    import behaviortreepy as cpp

    factory = cpp.BehaviorTreeFactory()
    for name, status in STATUS.items():
        factory.register_simple_action(name, lambda node, status=status: status)
    factory.register_behavior_tree_from_text(document(body(SIZE)))
    tree = factory.create_tree("Main")
    return tree.tick_exactly_once, cpp.Groot2Publisher(tree, port)


if __name__ == "__main__":
    main()
