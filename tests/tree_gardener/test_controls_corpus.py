"""The corpus of Nav2's control nodes: its content, and that it detects a broken rule."""

from __future__ import annotations

import functools
import gzip
import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from tests.tools.control_cases import Generator
from tree_gardener.conformance import run_case
from tree_gardener.controls.custom import CustomControl, CustomDecorator
from tree_gardener.status import Status

FILE = Path(__file__).parents[1] / "conformance" / "controls.jsonl.gz"
NODES = (
    *("NonblockingSequence", "PersistentSequence", "PipelineSequence"),
    *("RateController", "RecoveryNode", "RoundRobin"),
)


@functools.cache
def cases() -> list[dict[str, Any]]:
    return [json.loads(line) for line in gzip.decompress(FILE.read_bytes()).splitlines()]


def test_all_that_is_to_be_proven_is_there() -> None:
    found: Counter[str] = Counter()
    for case in cases():
        text = json.dumps(case)
        found.update(name for name in NODES if f"<{name}" in case["xml"])
        guards = (
            "_skipIf",
            "_failureIf",
            "_successIf",
            "_while",
            "_onSuccess",
            "_onFailure",
            "_post",
            "_onHalted",
        )
        found.update(word for word in guards if word in case["xml"])
        found["halts"] += '"op": "halt"' in text
        found["leaves halted"] += '"halt:' in text
        found["skips"] += "K" in case["xml"] or '"SKIPPED"' in text
        found["throws"] += "exception" in case["expected"][-1]
        found["time"] += '"op": "sleep"' in text and "<RateController" in case["xml"]
        found["SubTrees"] += "<SubTree" in case["xml"]
    assert len(cases()) >= 2000
    assert set(found) >= {*NODES, "halts", "throws"}
    assert min(found.values()) >= 200, found


def test_the_same_seed_makes_the_same_case() -> None:
    for case in (cases()[0], cases()[-1]):
        made = Generator(int(case["name"].removeprefix("C-"))).case()
        assert (made["xml"], made["ticks"]) == (case["xml"], case["ticks"])


def keep(self: CustomDecorator, status: Status) -> Status:
    return CustomControl.settle(self, status)


def reset(self: CustomControl, status: Status) -> Status:
    self.reset_children()
    return self.skipped() if status is Status.SKIPPED else self.complete(status)


def always_start(self: CustomControl) -> Status:
    if self.status is not Status.RUNNING:
        self.start()
    return self.result_of(self.update())


@pytest.mark.parametrize(
    ("cls", "rule", "broken"),
    [
        (CustomDecorator, "settle", keep),
        (CustomControl, "settle", reset),
        (CustomControl, "run", always_start),
        (CustomControl, "halt_children", lambda self, first: None),
        (CustomControl, "halt", lambda self: setattr(self, "status", Status.IDLE)),
    ],
)
def test_a_broken_rule_is_found(monkeypatch: pytest.MonkeyPatch, cls: type, rule: str, broken: Any) -> None:
    monkeypatch.setattr(cls, rule, broken)
    assert any(not run_case(case).passed for case in cases()[:300])
