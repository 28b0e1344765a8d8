"""Makes `tests/conformance/controls.jsonl.gz`: random trees of Nav2's nodes, run in BehaviorTree.CPP 4.10.

python -m tests.tools.control_cases --program FILE --btcpp FOLDER --nav2 FOLDER --build FOLDER

The three sources are not part of this repository (`oracle_build.py`). The cases depend on the seed alone.
"""

from __future__ import annotations

import argparse
import gzip
import json
import random
import subprocess
from pathlib import Path
from typing import Any, Final
from xml.sax.saxutils import quoteattr

from tests.tools.oracle_build import build

TARGET: Final = Path(__file__).resolve().parents[1] / "conformance" / "controls.jsonl.gz"
COUNT: Final = 2400
BATCH: Final = 100
CASE_S: Final = 20
OWN: Final = ("RoundRobin", "PipelineSequence", "RecoveryNode", "PersistentSequence", "NonblockingSequence")
PLAIN: Final = ("Sequence", "Fallback", "ReactiveSequence", "ReactiveFallback", "SequenceWithMemory")
OTHERS: Final = ("AsyncSequence", "Parallel", "ParallelAll", "IfThenElse", "WhileDoElse", "TryCatch")
KEYS: Final = ("i0", "i1", "i2")
POSITIONS: Final = ("p0", "p1")
RATES: Final = ("2", "2.5", "4", "5", "10", "20", "0", "-1", "{d0}", "{never}")
KEPT: Final = ("root", "status", "events", "before_events", "bb", "exception")


class Generator:
    """Makes one case. Throws, halts, guards, skips and SubTrees each come in a part of the cases only."""

    def __init__(self, seed: int) -> None:
        self.seed = seed
        self.rng = rng = random.Random(seed)  # noqa: S311 - a reproducible case, no secret
        self.count = 0
        self.trees: list[str] = []
        self.has_guards = rng.random() < 0.6
        self.has_throws = rng.random() < 0.25
        self.skips = rng.choice((0.0, 0.1, 0.3))

    def case(self) -> dict[str, Any]:
        rng = self.rng
        body = self.own(rng.randint(2, 4))
        trees = "".join([f'<BehaviorTree ID="Main">{body}</BehaviorTree>', *self.trees])
        ticks = rng.randint(4, 14)
        before = {str(tick): steps for tick in range(ticks) if (steps := self.steps())}
        return {
            "name": f"C-{self.seed:05}",
            "profile": "controls",
            "xml": f'<root BTCPP_format="4" main_tree_to_execute="Main">{trees}</root>',
            "ticks": ticks,
            "tick_mode": rng.choice(("exactly_once", "exactly_once", "once")),
            "bb": {
                **{key: ["int", rng.randint(0, 3)] for key in (*KEYS, *POSITIONS)},
                "d0": ["double", rng.choice((0.5, 4.0))],
            },
            **({"before": before} if before else {}),
        }

    def steps(self) -> list[dict[str, Any]]:
        rng = self.rng
        steps: list[dict[str, Any]] = []
        if rng.random() < 0.12:
            steps.append({"op": "halt"})
        if rng.random() < 0.5:
            steps.append({"op": "sleep", "ms": rng.choice((50, 100, 150, 250, 500))})
        if rng.random() < 0.15:
            key = rng.choice((*KEYS, *POSITIONS))
            steps.append({"op": "set", "key": key, "type": "int", "value": rng.randint(0, 4)})
        return steps

    def node(self, depth: int) -> str:
        kind = self.rng.random()
        if depth <= 0 or kind < 0.3:
            return self.leaf()
        if kind < 0.7:
            return self.own(depth)
        if kind < 0.85:
            return self.plain(depth)
        return self.decorator(depth) if kind < 0.95 else self.subtree(depth)

    def own(self, depth: int) -> str:
        rng = self.rng
        if rng.random() < 0.16:
            return self.element("RateController", {"hz": rng.choice(RATES)}, [self.node(depth - 1)])
        tag = rng.choice(OWN)
        ports: dict[str, str] = {}
        number = rng.randint(1, 4)
        if tag == "RoundRobin" and rng.random() < 0.7:
            ports["wrap_around"] = rng.choice(("true", "true", "false"))
        elif tag == "RecoveryNode":
            number = 2
            if rng.random() < 0.8:
                ports["number_of_retries"] = rng.choice(("0", "1", "2", "3", "-1", "{i0}", "{nothing}"))
        elif tag == "PersistentSequence":
            missing = self.has_throws and rng.random() < 0.2
            entry = rng.choice(("{p0}", "{p1}", "{p0}", "{p1}", "0", "1"))
            ports["current_child_idx"] = "{none}" if missing else entry
        return self.element(tag, ports, [self.node(depth - 1) for _ in range(number)])

    def plain(self, depth: int) -> str:
        rng = self.rng
        tag = rng.choice((*PLAIN, *OTHERS))
        low, high = {"IfThenElse": (2, 3), "WhileDoElse": (2, 3), "TryCatch": (2, 3)}.get(tag, (1, 3))
        children = [self.node(depth - 1) for _ in range(rng.randint(low, high))]
        if tag == "ReactiveSequence" and sum(child.startswith("<AsyncSequence") for child in children) > 1:
            tag = "ReactiveFallback"
        return self.element(tag, {}, children)

    def decorator(self, depth: int) -> str:
        rng = self.rng
        tag, ports = rng.choice(
            (
                *(("Inverter", {}), ("ForceSuccess", {}), ("ForceFailure", {}), ("RunOnce", {})),
                ("Repeat", {"num_cycles": str(rng.randint(1, 3))}),
                ("RetryUntilSuccessful", {"num_attempts": str(rng.randint(1, 3))}),
                (
                    "Precondition",
                    {"if": self.condition(), "else": rng.choice(("FAILURE", "SKIPPED", "RUNNING"))},
                ),
            )
        )
        return self.element(tag, ports, [self.node(depth - 1)])

    def subtree(self, depth: int) -> str:
        tree_id = self.fresh("T")
        self.trees.append(f'<BehaviorTree ID="{tree_id}">{self.own(depth - 1)}</BehaviorTree>')
        return self.element("SubTree", {"ID": tree_id, "_autoremap": "true"}, [])

    def leaf(self) -> str:
        rng = self.rng
        tag = rng.choice((*("Leaf",) * 6, "SyncLeaf", "Cond", "Script", "Inc"))
        if tag == "Script":
            return self.element(tag, {"code": self.assignment()}, [])
        if tag == "Inc":
            return self.element(tag, {"counter": f"{{{rng.choice(KEYS)}}}"}, [])
        letters = "SSSFFRRR" if tag == "Leaf" else "SSF"
        script = "".join(self.letter(letters) for _ in range(rng.randint(1, 7)))
        return self.element(tag, {"name": self.fresh(tag[0]), "script": script}, [])

    def letter(self, letters: str) -> str:
        rng = self.rng
        if rng.random() < self.skips:
            return "K"
        return "I" if self.has_throws and rng.random() < 0.06 else rng.choice(letters)

    def element(self, tag: str, ports: dict[str, str], children: list[str]) -> str:
        attributes = {**ports, **self.guards()}
        text = "".join(f" {name}={quoteattr(value)}" for name, value in attributes.items())
        return f"<{tag}{text}>{''.join(children)}</{tag}>" if children else f"<{tag}{text}/>"

    def fresh(self, prefix: str) -> str:
        self.count += 1
        return f"{prefix}{self.count}"

    def guards(self) -> dict[str, str]:
        rng = self.rng
        if not self.has_guards or rng.random() > 0.3:
            return {}
        found = {}
        for name in ("_failureIf", "_successIf", "_skipIf", "_while"):
            if rng.random() < 0.2:
                found[name] = self.condition()
        for name in ("_onSuccess", "_onFailure", "_post", "_onHalted"):
            if rng.random() < 0.2:
                found[name] = self.assignment()
        return found

    def condition(self) -> str:
        rng = self.rng
        return f"{rng.choice(KEYS)} {rng.choice(('==', '!=', '<', '>'))} {rng.randint(0, 3)}"

    def assignment(self) -> str:
        rng = self.rng
        if self.has_throws and rng.random() < 0.06:
            return "missing += 1"
        key = rng.choice(KEYS)
        return rng.choice((f"{key} := {rng.randint(0, 3)}", f"{key} := {rng.choice(KEYS)}", f"{key} += 1"))


def traces(program: Path, cases: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Runs cases in the program; one that never ends is left out."""
    text = "".join(f"{json.dumps(case)}\n" for case in cases)
    command = ["nice", "-n", "19", str(program)]
    try:
        done = subprocess.run(
            command, input=text, text=True, capture_output=True, timeout=CASE_S, check=False
        )
    except subprocess.TimeoutExpired:
        done = None
    # The library itself prints warnings there, too.
    lines = [line for line in done.stdout.split("\n") if line.startswith("{")] if done is not None else []
    if len(lines) == len(cases):
        return [json.loads(line) for line in lines]
    if len(cases) == 1:
        print(f"left out: {cases[0]['name']}, which never ends")
        return []
    # A tree whose `_onHalted` raises ends the program when it is destroyed, after its trace was printed.
    middle = len(lines) or len(cases) // 2
    found = [json.loads(line) for line in lines] if lines else traces(program, cases[:middle])
    return found + traces(program, cases[middle:])


def compact(case: dict[str, Any]) -> dict[str, Any]:
    """Returns a case with what is compared only."""
    expected = [
        {key: line[key] for key in KEPT if line.get(key) or key == "status"} for line in case["expected"]
    ]
    names = ("name", "xml", "ticks", "tick_mode", "bb", "before")
    kept: dict[str, Any] = {key: case[key] for key in names if key in case}
    final = case.get("final_halt")
    return {**kept, "expected": expected, **({"final_halt": final} if final else {})}


def write_cases(output: Path, program: Path, cases: list[dict[str, Any]]) -> None:
    """Runs cases in BehaviorTree.CPP, and writes those that it can run with their traces."""
    found = [
        case
        for first in range(0, len(cases), BATCH)
        for case in traces(program, cases[first : first + BATCH])
        if "oracle_error" not in case and "expected" in case
    ]
    lines = "".join(f"{json.dumps(compact(case), separators=(',', ':'))}\n" for case in found)
    output.write_bytes(gzip.compress(lines.encode(), mtime=0))
    print(
        f"{len(found)} cases, {sum('exception' in case['expected'][-1] for case in found)} end with an error"
    )


def main() -> None:
    """Makes the file."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("program", "btcpp", "nav2", "build"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--output", type=Path, default=TARGET)
    given = parser.parse_args()
    program = build(given.build, given.program, given.btcpp, given.nav2)
    write_cases(given.output, program, [Generator(seed).case() for seed in range(given.count)])


if __name__ == "__main__":
    main()
