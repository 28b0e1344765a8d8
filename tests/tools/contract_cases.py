"""Makes `tests/conformance/contract.jsonl.gz`: control nodes that make all calls of the contract.

python -m tests.tools.contract_cases --program FILE --btcpp FOLDER --build FOLDER

Each of their ticks and halts is a program, such as `t0 ?R h1 =L`: tick child 0, return if it is RUNNING, halt
child 1, return the last result. `contract_nodes.hpp` runs it in BehaviorTree.CPP 4.10, and
`tests/tree_gardener/programmed.py` in the engine. The cases depend on the seed alone.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Final

from tests.tools.control_cases import Generator, write_cases
from tests.tools.oracle_build import build_contract

TARGET: Final = Path(__file__).resolve().parents[1] / "conformance" / "contract.jsonl.gz"
COUNT: Final = 1000
FOUND: Final = (2412, 3744)
"""Seeds that once showed a difference."""
WAKING: Final = ("<Async", "<SequenceWithMemory", "<Repeat", "<Retry")
"""Nodes that wake the tree up themselves: below a node that halts them, `tickOnce` may never return."""


class ContractGenerator(Generator):
    """Makes one case. In a part of the cases a wake-up ticks the tree again (`once`)."""

    def __init__(self, seed: int) -> None:
        super().__init__(seed)
        self.is_once = self.rng.random() < 0.3

    def case(self) -> dict[str, Any]:
        return {**super().case(), "tick_mode": "once" if self.is_once else "exactly_once"}

    def steps(self) -> list[dict[str, Any]]:
        return [step for step in super().steps() if step["op"] != "sleep"]

    def plain(self, depth: int) -> str:
        while True:
            made = super().plain(depth)
            if not (self.is_once and made.startswith(WAKING)):
                return made

    def decorator(self, depth: int) -> str:
        while True:
            made = super().decorator(depth)
            if not (self.is_once and made.startswith(WAKING)):
                return made

    def own(self, depth: int) -> str:
        rng = self.rng
        is_decorator = rng.random() < 0.35
        tags = ("OwnDecorator", "OwnDecoratorMarked") if is_decorator else ("Own", "OwnMarked")
        number = 1 if is_decorator else rng.randint(1, 4)
        ports = {"program": "|".join(self.program(number) for _ in range(rng.randint(1, 5)))}
        if rng.random() < 0.5:
            ports["on_halt"] = "|".join(self.halting(number) for _ in range(rng.randint(1, 3)))
        return self.element(rng.choice(tags), ports, [self.node(depth - 1) for _ in range(number)])

    def halting(self, number: int) -> str:
        rng = self.rng
        words = (f"h{rng.randrange(number)}", f"a{rng.randint(0, number)}", "r", "c", "s", "w")
        return " ".join(rng.choice(words) for _ in range(rng.randint(1, 3)))

    def program(self, number: int) -> str:
        rng = self.rng
        words: list[str] = []
        for _ in range(rng.randint(1, 7)):
            if rng.random() < 0.5:
                catches = self.has_throws and rng.random() < 0.3
                words.append(f"{'x' if catches else 't'}{rng.randrange(number)}")
                if rng.random() < 0.3:
                    words.append(f"?{rng.choice('RSFK')}")
            else:
                halts = (f"h{rng.randrange(number)}", f"a{rng.randint(0, number)}", "r", "H")
                words.append(rng.choice((*halts, "m", "w", "c", "c", "s")))
        wrong = rng.random() if self.has_throws else 1.0
        words.append("E" if wrong < 0.05 else "=I" if wrong < 0.1 else f"={rng.choice('SFRKLLL')}")
        return " ".join(words)


def main() -> None:
    """Makes the file."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("program", "btcpp", "build"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--output", type=Path, default=TARGET)
    given = parser.parse_args()
    program = build_contract(given.build, given.program, given.btcpp)
    seeds = [*range(given.first, given.first + given.count), *FOUND]
    write_cases(given.output, program, [ContractGenerator(seed).case() for seed in seeds])


if __name__ == "__main__":
    main()
