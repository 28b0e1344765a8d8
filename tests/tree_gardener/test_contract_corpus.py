"""The contract of control nodes and decorators, call by call, as BehaviorTree.CPP 4.10 keeps it."""

from __future__ import annotations

import functools
import gzip
import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from tests.tools.contract_cases import FOUND, ContractGenerator
from tests.tree_gardener.programmed import programmed
from tree_gardener.conformance import run_case
from tree_gardener.controls.custom import CustomControl, CustomDecorator
from tree_gardener.generated import generation

FILE = Path(__file__).parents[1] / "conformance" / "contract.jsonl.gz"
WORDS = ("t0", "t3", "x", "h", "a", "r", "m", "H", "w", "c", "s", "E", "=S", "=F", "=R", "=K", "=I", "=L")


@functools.cache
def cases() -> list[dict[str, Any]]:
    return [json.loads(line) for line in gzip.decompress(FILE.read_bytes()).splitlines()]


@pytest.mark.parametrize(("generates", "number"), [(True, 0), (False, 300)], ids=["all", "some"])
def test_every_case_is_as_there(monkeypatch: pytest.MonkeyPatch, number: int, *, generates: bool) -> None:
    monkeypatch.setattr(generation, "ENABLED", generates)
    found = [run_case(case, programmed) for case in cases()[-number:]]
    assert [outcome for outcome in found if not outcome.passed] == []


def test_each_call_is_there_often() -> None:
    found: Counter[str] = Counter()
    for case in cases():
        parts = case["xml"].replace('"', " ").replace("|", " ").split()
        found.update({word for word in WORDS for part in parts if part.startswith(word)})
        found["throws"] += "exception" in case["expected"][-1]
        found["caught"] += '"caught:' in json.dumps(case)
        found["decorator"] += "<OwnDecorator" in case["xml"]
        found["on_halt"] += "on_halt" in case["xml"] and '"halting ' in json.dumps(case)
        found["once"] += case["tick_mode"] == "once"
    assert len(cases()) >= 990
    assert set(found) > set(WORDS)
    assert min(found.values()) >= 20, found
    names = {case["name"] for case in cases()}
    assert {f"C-{seed:05}" for seed in FOUND} <= names


def test_the_same_seed_makes_the_same_case() -> None:
    for case in (cases()[0], cases()[-1]):
        made = ContractGenerator(int(case["name"].removeprefix("C-"))).case()
        assert (made["xml"], made["ticks"]) == (case["xml"], case["ticks"])


@pytest.mark.parametrize(
    ("cls", "rule", "broken"),
    [
        (CustomControl, "halt_by_itself", lambda self: self.reset_children()),
        (CustomControl, "halt_child", lambda self, index: self.halt_children(index)),
        (CustomControl, "mark_running", lambda self: None),
        (CustomDecorator, "settle", CustomControl.settle),
    ],
)
def test_a_broken_rule_is_found(monkeypatch: pytest.MonkeyPatch, cls: type, rule: str, broken: Any) -> None:
    monkeypatch.setattr(cls, rule, broken)
    assert any(not run_case(case, programmed).passed for case in cases()[:300])
