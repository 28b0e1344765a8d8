"""Random trees whose leaves return random results and write random values."""

from __future__ import annotations

import itertools
import random

import py_trees

from tree_gardener.ports import Port, set_output

STATUS = py_trees.common.Status
CONTROLS = (
    "Sequence",
    "Fallback",
    "ReactiveSequence",
    "ReactiveFallback",
    "SequenceWithMemory",
    "AsyncSequence",
    "AsyncFallback",
    "Parallel",
    "ParallelAll",
    "IfThenElse",
    "WhileDoElse",
    "TryCatch",
)
DECORATORS = (
    "<Inverter{}>",
    "<ForceSuccess{}>",
    "<ForceFailure{}>",
    '<Repeat num_cycles="2"{}>',
    "<RunOnce{}>",
    '<RetryUntilSuccessful num_attempts="2"{}>',
    "<KeepRunningUntilFailure{}>",
    '<Timeout msec="200"{}>',
    '<Delay delay_msec="100"{}>',
)


class RandomLeaf(py_trees.behaviour.Behaviour):
    RESULTS: tuple = (STATUS.SUCCESS, STATUS.FAILURE, STATUS.RUNNING)
    OUTPUT_PORTS = {"value": Port(float)}  # noqa: RUF012 - as users write
    chance = random.Random(0)  # noqa: S311 - a reproducible tree, no secret

    def update(self):
        if self.chance.random() < 0.3:
            set_output(self, "value", float(self.chance.randrange(10)))
        return self.chance.choice(self.RESULTS)


class Act(RandomLeaf):
    pass


class Check(RandomLeaf):
    __test__ = False
    NODE_KIND = "Condition"
    RESULTS: tuple = (STATUS.SUCCESS, STATUS.FAILURE)


LEAVES = {"Act": Act, "Check": Check}


def random_tree(chance: random.Random, *, size: int = 12) -> str:
    """Returns the body of a tree; each leaf has its own name and writes its own entry."""
    numbers = itertools.count(1)
    left = [size]

    def node(depth: int) -> str:
        left[0] -= 1
        if depth > 4 or left[0] <= 0 or chance.random() < 0.3:
            n = next(numbers)
            kind = chance.choice(("Act", "Act", "Check"))
            return f'<{kind} name="leaf {n}" value="{{v{n}}}"/>'
        if chance.random() < 0.4:
            opening = chance.choice(DECORATORS).format("")
            return f"{opening}{node(depth + 1)}</{opening[1:-1].split()[0]}>"
        kind = chance.choice(CONTROLS)
        least, most = {"IfThenElse": (2, 3), "WhileDoElse": (2, 3), "TryCatch": (2, 3)}.get(kind, (1, 3))
        return f"<{kind}>{''.join(node(depth + 1) for _ in range(chance.randint(least, most)))}</{kind}>"

    return node(0)
