"""Every case of BehaviorTree.CPP 4.10, and for every document that it refuses a repaired twin that loads."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tree_gardener import LoadError, Tree
from tree_gardener.conformance import DEVIATIONS, run_case, run_file
from tree_gardener.conformance.leaves import Trace, leaves
from tree_gardener.script import compiled

CASES = Path(__file__).parents[2] / "conformance"
FILES = {
    "accepts.jsonl": 8,
    "added.jsonl": 982,
    "controls.jsonl.gz": 2394,
    "entry_types.jsonl": 36,
    "focused.jsonl": 123,
    "kinds.jsonl.gz": 959,
    "random.jsonl": 300,
    "rejects.jsonl": 43,
    "script_table.json": 96,
    "throws.jsonl": 25,
    "timed.jsonl": 17,
}
REJECTS = {case["name"]: case for case in map(json.loads, (CASES / "rejects.jsonl").read_text().splitlines())}
TREE_B = '</BehaviorTree><BehaviorTree ID="B"><AlwaysSuccess/></BehaviorTree></root>'

# The only change that makes each refused document load.
REPAIRS: dict[str, tuple[tuple[str, str], ...]] = {
    "R-unclosed": (("</BehaviorTree>", "<AlwaysSuccess/></Sequence></BehaviorTree>"),),
    "R-unquoted-attr": (("BTCPP_format=4", 'BTCPP_format="4"'),),
    "R-empty": (("", '<root><BehaviorTree ID="Main"><AlwaysSuccess/></BehaviorTree></root>'),),
    "R-wrong-root": (("tree BTCPP", "root BTCPP"), ("</tree>", "</root>")),
    "R-no-main": (('<root BTCPP_format="4">', '<root BTCPP_format="4" main_tree_to_execute="A">'),),
    "R-tree-no-id": (("<BehaviorTree>", '<BehaviorTree ID="B">'),),
    "R-tree-two-children": (("<AlwaysSuccess/><AlwaysSuccess/>", "<AlwaysSuccess/>"),),
    "R-tree-id-space": (("My Tree", "MyTree"),),
    "R-tree-id-dot": (("a.b", "a_b"),),
    "R-unknown-node": (("Sequenze", "Sequence"),),
    "R-v3-name": (("SequenceStar", "SequenceWithMemory"),),
    "R-unknown-explicit": (('ID="Nope"', 'ID="AlwaysSuccess"'),),
    "R-explicit-control-no-id": (("<Control>", '<Control ID="Sequence">'),),
    "R-seq-empty": (("<Sequence/>", "<Sequence><AlwaysSuccess/></Sequence>"),),
    "R-inverter-empty": (("<Inverter/>", "<Inverter><AlwaysSuccess/></Inverter>"),),
    "R-action-child": (("<AlwaysSuccess><AlwaysSuccess/></AlwaysSuccess>", "<AlwaysSuccess/>"),),
    "R-trycatch-one": (("<AlwaysSuccess/>", "<AlwaysSuccess/><AlwaysSuccess/>"),),
    "R-subtree-no-id": (("<SubTree/>", '<SubTree ID="B"/>'), ("</BehaviorTree></root>", TREE_B)),
    "R-subtree-self": (('SubTree ID="Main"', 'SubTree ID="B"'), ("</BehaviorTree></root>", TREE_B)),
    "R-subtree-node-id": (('SubTree ID="Sequence"', 'SubTree ID="B"'), ("</BehaviorTree></root>", TREE_B)),
    "R-subtree-bad-autoremap": (("maybe", "true"),),
    "R-model-two": (("<TreeNodesModel/><TreeNodesModel/>", "<TreeNodesModel/>"),),
    "R-model-subtree-noid": (("<SubTree><input_port", '<SubTree ID="B"><input_port'),),
    "R-model-port-digit": (('name="1p"', 'name="p1"'),),
    "R-unknown-port-builtin": ((' foo="1"', ""),),
    "R-port-double": (("x1", "1"),),
    "R-port-int-range": (("99999999999", "999999999"),),
    "R-parallel-word": (('failure_count="x"', 'failure_count="1"'),),
    "R-runonce-bool": (("perhaps", "true"),),
    "R-loop-bad-queue": (("1;x", "1;2"),),
    "R-type-conflict": (('<SetBool value="1" to="{v}"/>', '<SetBool value="1" to="{w}"/>'),),
    "R-type-conflict-string": (('variable="{v}"', 'variable="{w}"'),),
    "R-script-syntax": (("x := ", "x := 1"),),
    "R-script-paren": (("(1 + 2", "(1 + 2)"),),
    "R-script-number": (("3foo", "3"),),
    "R-script-op": (("5 % 2", "5 / 2"),),
    "R-script-ternary": (("true ? 1", "true ? 1 : 2"),),
    "R-pre-syntax": (("x ==", "x == 1"),),
    "R-post-syntax": (("x := := 1", "x := 1"),),
    "R-include-nopath": (("<include/>", ""),),
    "R-deep": (("<Inverter>", ""), ("</Inverter>", "")),
    "R-rseq-two-async": (
        ("<AsyncSequence><AlwaysSuccess/></AsyncSequence></ReactiveSequence>", "</ReactiveSequence>"),
    ),
    "R-unused-unknown-node": (("<Nope/>", "<AlwaysSuccess/>"),),
}


@pytest.mark.parametrize(("name", "number"), FILES.items())
def test_every_case_passes(name: str, number: int) -> None:
    outcomes = list(run_file(CASES / name))
    assert [outcome for outcome in outcomes if not outcome.passed] == []
    assert len(outcomes) == number


@pytest.mark.parametrize("name", ["focused.jsonl", "random.jsonl", "script_table.json", "throws.jsonl"])
def test_cases_pass_where_the_evaluator_runs_all_scripts(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, "COMPILES", False)
    assert [outcome for outcome in run_file(CASES / name) if not outcome.passed] == []


def test_what_differs_on_purpose_differs_for_the_reason_that_is_named() -> None:
    outcomes = list(run_file(CASES / "deviations.jsonl"))
    assert {outcome.deviation for outcome in outcomes} == set(DEVIATIONS)
    assert not any(outcome.passed or outcome.failed for outcome in outcomes)
    assert len(outcomes) == 122


def test_a_difference_without_that_reason_is_a_failure() -> None:
    cases = [json.loads(line) for line in (CASES / "deviations.jsonl").read_text().splitlines()]
    for case in cases:
        if not case["name"].startswith("D-"):
            continue
        direct = case["xml"].replace('x="{@g}"', 'x="{g}"').replace('u="{@g}"', 'u="{g}"')
        assert not run_case({**case, "xml": direct}).deviation


def test_every_reject_has_a_twin() -> None:
    assert set(REPAIRS) == set(REJECTS)


@pytest.mark.parametrize("name", REPAIRS)
def test_a_refused_document_is_located_and_its_repaired_twin_loads(name: str) -> None:
    text = REJECTS[name]["xml"]
    with pytest.raises(LoadError) as refused:
        load(text)
    for diagnostic in refused.value.diagnostics:
        assert diagnostic.code.startswith("TG")
        assert diagnostic.line >= 1
        assert diagnostic.column >= 1
        assert diagnostic.message
        assert diagnostic.hint, "a refusal says what to do"
    for old, new in REPAIRS[name]:
        assert old in text
        text = text.replace(old, new) if old else new
    load(text)


def load(text: str) -> Tree:
    return Tree.from_xml(text, leaves(Trace()))


def test_a_case_that_expects_something_else_fails() -> None:
    case: dict[str, Any] = json.loads((CASES / "focused.jsonl").read_text().splitlines()[0])
    for change in (
        {"root": "FAILURE"},
        {"status": "III"},
        {"events": ["start:a"]},
        {"bb": {"": {"x": ["int", 1]}}},
    ):
        expected = [{**case["expected"][0], **change}, *case["expected"][1:]]
        assert run_case({**case, "expected": expected}).differences
    assert run_case({**case, "nodes": case["nodes"][:-1]}).differences
    assert run_case(case).passed


def test_a_case_that_must_load_or_be_refused_and_is_not_fails() -> None:
    good = {"name": "good", "xml": '<root><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>'}
    assert not run_case({**good, "rejected_410": True, "first_tick_410": None}).passed
    assert not run_case({**good, "rejected_410": False, "first_tick_410": "FAILURE"}).passed
    assert not run_case({"name": "bad", "xml": "<root>", "rejected_410": False}).passed
