"""Random trees that both engines can run.

behaviortreepy's Python leaves have no ports, so that a leaf's script is a part of its name: ``L3.RRS``. Left
out is what the two versions of BT.CPP do differently (`docs/explanation/engine.md`), and what crashes or
never ends.
"""

from __future__ import annotations

import dataclasses
import functools
import random
from xml.sax.saxutils import quoteattr

KEYS = ("i0", "i1", "i2")
SHARED = 4096
"""How many cases a process keeps: the short run of every suite takes its trees from the first seeds."""


@dataclasses.dataclass(frozen=True)
class Spec:
    """A node: attributes as in XML, and its children."""

    tag: str
    attributes: tuple[tuple[str, str], ...] = ()
    children: tuple[Spec, ...] = ()

    def xml(self) -> str:
        """The node as XML."""
        attributes = "".join(f" {name}={quoteattr(value)}" for name, value in self.attributes)
        if not self.children:
            return f"<{self.tag}{attributes}/>"
        return f"<{self.tag}{attributes}>{''.join(child.xml() for child in self.children)}</{self.tag}>"

    @property
    def size(self) -> int:
        """Number of nodes."""
        return 1 + sum(child.size for child in self.children)


@dataclasses.dataclass(frozen=True)
class Case:
    """A tree and what is done to it; `trees` by ID, the first is the main one."""

    seed: int
    trees: tuple[tuple[str, Spec], ...]
    ticks: int
    mode: str
    halts: tuple[int, ...]
    writes: tuple[tuple[int, str, int], ...]

    def xml(self) -> str:
        """The document."""
        return self._xml

    @functools.cached_property
    def _xml(self) -> str:
        bodies = "".join(
            f'<BehaviorTree ID="{name}">{spec.xml()}</BehaviorTree>' for name, spec in self.trees
        )
        return f'<root BTCPP_format="4" main_tree_to_execute="{self.trees[0][0]}">{bodies}</root>'

    @property
    def size(self) -> int:
        """Number of nodes in all trees."""
        return sum(spec.size for _, spec in self.trees)


@functools.lru_cache(SHARED)
def generate(seed: int) -> Case:
    """The case of a seed, shared by all suites of a process."""
    return make(seed)


def make(seed: int) -> Case:
    """Makes the case of a seed."""
    return _Generator(seed).case()


class _Generator:
    def __init__(self, seed: int) -> None:
        self.seed = seed
        self.random = random.Random(seed)  # noqa: S311 - a reproducible case, no secret
        self.count = 0
        self.trees: list[tuple[str, Spec]] = []
        self.mode = self.random.choice(("once", "exactly_once"))
        self.scripted = self.random.random() < 0.7
        self.conditioned = self.random.random() < 0.5

    def case(self) -> Case:
        rng = self.random
        main = self.node(rng.randint(2, 6))
        ticks = rng.randint(4, 14)
        return Case(
            seed=self.seed,
            trees=(("Main", main), *self.trees),
            ticks=ticks,
            mode=self.mode,
            halts=tuple(tick for tick in range(ticks) if rng.random() < 0.08),
            writes=tuple(
                (tick, rng.choice(KEYS), rng.randint(0, 4)) for tick in range(ticks) if rng.random() < 0.15
            ),
        )

    def name(self, prefix: str) -> str:
        self.count += 1
        return f"{prefix}{self.count}"

    def node(self, depth: int, *, sync: bool = False) -> Spec:
        rng = self.random
        kind = rng.random()
        if depth <= 0 or kind < 0.2:
            spec = self.leaf(sync=sync)
        elif kind < 0.65 and not sync:
            spec = self.control(depth)
        elif kind < 0.93:
            spec = self.decorator(depth, sync=sync)
        else:
            spec = self.subtree(depth, sync=sync)
        return self.with_conditions(spec)

    def children(self, depth: int, low: int, high: int) -> tuple[Spec, ...]:
        return tuple(self.node(depth - 1) for _ in range(self.random.randint(low, high)))

    def control(self, depth: int) -> Spec:
        rng = self.random
        tag = rng.choice(
            (
                *(
                    "Sequence",
                    "Fallback",
                    "ReactiveSequence",
                    "ReactiveFallback",
                    "AsyncSequence",
                    "AsyncFallback",
                ),
                *("SequenceWithMemory", "Parallel", "ParallelAll", "IfThenElse", "WhileDoElse", "Switch"),
            )
        )
        if tag in ("IfThenElse", "WhileDoElse"):
            return Spec(tag, self.named(), self.children(depth, 2, 3))
        if tag == "Switch":
            cases = rng.randint(2, 4)
            ports = [("variable", rng.choice(("{i0}", "{i1}", "2", "{nothing}")))]
            ports += [(f"case_{n + 1}", rng.choice(("0", "1", "2", "3", "x"))) for n in range(cases)]
            variable = ports[0][1]
            if variable in ("{i0}", "{i1}"):
                # A string port refuses an entry that was declared int: read it through a Script-made copy.
                ports[0] = ("variable", "{u" + variable[2:])
            return Spec(f"Switch{cases}", (*self.named(), *ports), self.children(depth, cases + 1, cases + 1))
        children = self.children(depth, 1, 4)
        if tag == "ReactiveSequence" and sum(child.tag == "AsyncSequence" for child in children) > 1:
            tag = "ReactiveFallback"
        attributes = self.named()
        limit = len(children)
        if tag == "Parallel" and rng.random() < 0.8:
            attributes += (("success_count", str(rng.randint(-limit - 1, limit))),)
            attributes += (("failure_count", str(rng.randint(-limit - 1, limit))),)
        if tag == "ParallelAll" and rng.random() < 0.8:
            attributes += (("max_failures", str(rng.randint(-limit - 1, limit))),)
        return Spec(tag, attributes, children)

    def named(self) -> tuple[tuple[str, str], ...]:
        return (("name", self.name("n")),) if self.random.random() < 0.5 else ()

    def decorator(self, depth: int, *, sync: bool) -> Spec:
        rng = self.random
        tag = rng.choice(
            (
                *("Inverter", "ForceSuccess", "ForceFailure", "Repeat", "RetryUntilSuccessful", "RunOnce"),
                *(
                    "KeepRunningUntilFailure",
                    "Precondition",
                    "LoopInt",
                    "SkipUnlessUpdated",
                    "WaitValueUpdate",
                ),
            )
        )
        if tag in ("KeepRunningUntilFailure", "WaitValueUpdate", "LoopInt") and sync:
            tag = "Inverter"
        if tag == "KeepRunningUntilFailure" and self.mode == "once":
            tag = "ForceSuccess"  # over a child that yields it would never return
        ports: tuple[tuple[str, str], ...] = ()
        if tag == "Repeat":
            ports = (("num_cycles", str(rng.choice((0, 1, 2, 3, *((-1,) if self.mode != "once" else ()))))),)
        elif tag == "RetryUntilSuccessful":
            ports = (
                ("num_attempts", str(rng.choice((0, 1, 2, 3, *((-1,) if self.mode != "once" else ()))))),
            )
        elif tag == "RunOnce" and rng.random() < 0.5:
            ports = (("then_skip", rng.choice(("true", "false"))),)
        elif tag == "Precondition":
            ports = (
                ("if", self.condition()),
                ("else", rng.choice(("SUCCESS", "FAILURE", "RUNNING", "SKIPPED"))),
            )
        elif tag == "LoopInt":
            queue = ";".join(str(rng.randint(0, 4)) for _ in range(rng.randint(1, 3)))
            ports = (
                ("queue", queue),
                ("value", "{i2}"),
                ("if_empty", rng.choice(("SUCCESS", "FAILURE", "SKIPPED"))),
            )
        elif tag in ("SkipUnlessUpdated", "WaitValueUpdate"):
            ports = (("entry", rng.choice(("{i0}", "{i1}", "{w}"))),)
        # 4.8.2 does not halt the child of these two: it must never be RUNNING, nor skipped with that status.
        updated = tag in ("SkipUnlessUpdated", "WaitValueUpdate")
        child = self.leaf(sync=True) if updated else self.node(depth - 1, sync=sync)
        return Spec(tag, (*self.named(), *ports), (child,))

    def subtree(self, depth: int, *, sync: bool) -> Spec:
        rng = self.random
        tree_id = self.name("T")
        body = self.node(depth - 1, sync=True) if sync or rng.random() < 0.3 else self.control(depth)
        self.trees.append((tree_id, body))
        ports: tuple[tuple[str, str], ...] = ()
        if rng.random() < 0.4:
            ports = (("_autoremap", "true"),)
            if rng.random() < 0.5:
                ports += (("i0", "{i1}"),)
        else:
            ports = tuple((key, rng.choice((f"{{{key}}}", "{=}", f"{{{rng.choice(KEYS)}}}"))) for key in KEYS)
            ports += tuple((key, "{=}") for key in ("u0", "u1", "w"))
        return Spec("SubTree", (("ID", tree_id), *self.named(), *ports))

    def leaf(self, *, sync: bool) -> Spec:  # noqa: PLR0911 - one for each kind
        rng = self.random
        kinds = (
            ["SyncLeaf", "Cond", "AlwaysSuccess", "AlwaysFailure"]
            if sync
            else ["Leaf"] * 5 + ["SyncLeaf", "Cond"]
        )
        if self.scripted:
            kinds += ["Script", "ScriptCondition", "WasEntryUpdated", "SetBlackboard", "UnsetBlackboard"]
        tag = rng.choice(kinds)
        if tag in ("Leaf", "SyncLeaf", "Cond"):
            letters = "SSFFRRK" if tag == "Leaf" else "SF"
            script = "".join(rng.choice(letters) for _ in range(rng.randint(1, 7)))
            return Spec(tag, (("name", f"{self.name(tag[0])}.{script}"),))
        if tag == "Script":
            return Spec(tag, (("code", self.assignment()),))
        if tag == "ScriptCondition":
            return Spec(tag, (("code", self.condition()),))
        if tag == "WasEntryUpdated":
            return Spec(tag, (("entry", rng.choice(("{i0}", "{i1}", "{w}"))),))
        if tag == "SetBlackboard":
            return Spec(
                tag, (("value", rng.choice(("7", "text"))), ("output_key", rng.choice(("fresh", "other"))))
            )
        if tag == "UnsetBlackboard":
            return Spec(tag, (("key", rng.choice(("fresh", "other"))),))
        return Spec(tag)

    def with_conditions(self, spec: Spec) -> Spec:
        rng = self.random
        if not self.conditioned or rng.random() > 0.25:
            return spec
        extra = []
        for name in ("_failureIf", "_successIf", "_skipIf", "_while"):
            if rng.random() < 0.2:
                extra.append((name, self.condition()))
        for name in ("_onSuccess", "_onFailure", "_post", "_onHalted"):
            if rng.random() < 0.2:
                extra.append((name, self.assignment()))
        rng.shuffle(extra)
        return dataclasses.replace(spec, attributes=(*spec.attributes, *extra))

    # Scripts: fully in parentheses, because the two grammars differ in their levels.

    def number(self, depth: int = 2) -> str:
        rng = self.random
        if depth == 0 or rng.random() < 0.5:
            return rng.choice((*KEYS, str(rng.randint(0, 4)), str(rng.randint(0, 4))))
        return f"({self.number(depth - 1)} {rng.choice('+-*')} {self.number(depth - 1)})"

    def condition(self, depth: int = 2) -> str:
        rng = self.random
        if depth > 0 and rng.random() < 0.25:
            return f"({self.condition(depth - 1)}) {rng.choice(('&&', '||'))} ({self.condition(depth - 1)})"
        return f"{self.number()} {rng.choice(('==', '!=', '<', '>', '<=', '>='))} {self.number()}"

    def assignment(self) -> str:
        rng = self.random
        key = rng.choice(KEYS)
        return rng.choice(
            (
                f"{key} := {rng.randint(0, 4)}",
                f"{key} = {rng.choice(KEYS)}",
                f"{key} += 1",
                f"{key} := ({self.condition(1)}) ? {rng.randint(0, 4)} : {rng.choice(KEYS)}",
                f"w := {rng.randint(0, 4)}",
                f"u0 := {rng.randint(0, 3)}; u1 := {rng.randint(0, 3)}",
                f"{key} := ({rng.choice(KEYS)} + 1)",
            )
        )
