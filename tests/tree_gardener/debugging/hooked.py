"""Random trees with forced results: in BehaviorTree.CPP by hooks of its Groot2 publisher, here by forces."""

from __future__ import annotations

import dataclasses
import json
import os
import pickle
import random
import signal
import socket
import sys
from typing import TYPE_CHECKING, Any

from tests.tree_gardener.fuzz.generate import Case, Spec, generate
from tests.tree_gardener.fuzz.reference import Line, run_reference
from tests.tree_gardener.fuzz.trace import run_ours
from tests.tree_gardener.groot.zmtp import Groot2
from tree_gardener import LoadError, Status
from tree_gardener.debugging import Debugger, Force, Stop

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener import Tree

ENDLESS_S = 4
RESULTS = (Status.SUCCESS, Status.FAILURE)


@dataclasses.dataclass(frozen=True)
class Forced:
    """A case, and the results that are forced from its first tick on, with the positions of their hooks.

    The position makes no difference: BehaviorTree.CPP's publisher reads it, and calls every hook before the
    tick (4.8.2, seen in these runs: a node with a hook after its tick is not ticked).
    """

    case: Case
    forces: tuple[tuple[Force, int], ...]


def forced(seed: int) -> Forced:
    """A random case with one to three forced results.

    A result that is forced once is forced on a leaf that is done within its tick: a node that is RUNNING when
    its result is forced is halted here, and is not halted there. Conditions of IfThenElse and WhileDoElse are
    left out: they keep SUCCESS or FAILURE, with which BehaviorTree.CPP ticks a node without its hook.
    """
    case = generate(seed)
    chance = random.Random(seed)  # noqa: S311 - a reproducible case, no secret
    specs = _in_order(dict(case.trees), case.trees[0][1])
    forces: dict[int, tuple[Force, int]] = {}
    for _ in range(chance.randint(1, 3)):
        uid = chance.randint(1, len(specs))
        if uid > 1 and specs[uid - 2].tag in ("IfThenElse", "WhileDoElse"):
            continue
        is_once = _is_quick(specs[uid - 1]) and chance.random() < 0.5
        forces[uid] = Force(uid, chance.choice(RESULTS), is_once), chance.randint(0, 1)
    return Forced(case, tuple(forces.values()))


def _in_order(trees: dict[str, Spec], spec: Spec) -> list[Spec]:
    """The nodes in the order of their uids."""
    below = [trees[dict(spec.attributes)["ID"]]] if spec.tag == "SubTree" else spec.children
    return [spec, *(node for child in below for node in _in_order(trees, child))]


def _is_quick(spec: Spec) -> bool:
    """Whether a node is a leaf that is done within its tick."""
    return not spec.children and spec.tag not in ("Leaf", "SubTree")


def hook_of(force: Force, position: int) -> dict[str, Any]:
    """The hook of BehaviorTree.CPP that does what a force does."""
    return {
        "enabled": True,
        "uid": force.uid,
        "mode": 1,
        "once": force.once,
        "position": position,
        "desired_status": force.status.name,
    }


def theirs(wanted: Forced) -> list[Line]:
    """The trace of BehaviorTree.CPP."""

    def prepare(tree: Any) -> Any:
        import behaviortreepy as cpp

        port = free_port()
        publisher = cpp.Groot2Publisher(tree, port)
        client = Groot2(port)
        client.insert_hooks([hook_of(force, position) for force, position in wanted.forces])
        client.close()
        return publisher

    return run_reference(wanted.case, prepare)


def ours(wanted: Forced) -> list[Line]:
    """Our trace, in the same form."""

    def hold(stop: Stop) -> None:
        raise AssertionError(f"nothing stops at {stop}")

    def prepare(tree: Tree) -> None:
        debugger = Debugger(hold)
        tree.debug(debugger)
        for force, _ in wanted.forces:
            debugger.force(force)

    try:
        return run_ours(wanted.case, prepare)
    except LoadError:
        return [{"load": "refused"}]


def free_port() -> int:
    """A port that is free, with the next one."""
    while True:
        with socket.socket() as first, socket.socket() as second:
            first.bind(("127.0.0.1", 0))
            port: int = first.getsockname()[1]
            try:
                second.bind(("127.0.0.1", port + 1))
            except OSError:
                continue
            return port


def run_batch(theirs: Callable[[Any], list[Line]]) -> None:
    """Runs a batch of cases in BehaviorTree.CPP, as `tests.tree_gardener.fuzz.child` does."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for case in pickle.load(sys.stdin.buffer):  # noqa: S301 - our own parent wrote it
        signal.alarm(ENDLESS_S)
        out.write(json.dumps(theirs(case)) + "\n")
        out.flush()


if __name__ == "__main__":
    run_batch(theirs)
