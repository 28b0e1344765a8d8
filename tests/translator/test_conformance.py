"""Trees that BehaviorTree.CPP refuses at loading have an error, and trees that it loads have none."""

from __future__ import annotations

import json

import pytest

from tests.translator.conftest import OPEN_ACTION, ROOT
from translator import TranslatorError, check, from_xml, to_xml

CASES = ROOT / "tests" / "conformance"
TYPED = """
import py_trees
from tree_gardener.ports import Port


class {name}(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {{"value": Port({type})}}
    OUTPUT_PORTS = {{"to": Port({type})}}

    def update(self):
        return py_trees.common.Status.SUCCESS
"""
TYPES = {"Int": "int", "Str": "str", "Double": "float", "Bool": "bool"}
OPEN = ("Leaf", "SyncLeaf", "Cond", "GetIntDef", "GetIntBB", "GetIntSame", "Inc")
ACTIONS = {f"{name}.py": OPEN_ACTION.format(name=name).encode() for name in OPEN} | {
    f"{verb}{name}.py": TYPED.format(name=f"{verb}{name}", type=type_).encode()
    for verb in ("Get", "Set")
    for name, type_ in TYPES.items()
}
# Reported and repaired at the import: the drawn tree does not have the fault any more.
REPAIRED = {
    "R-no-main": "BT0735",
    "R-tree-no-id": "BT0712",
    "R-tree-two-children": "BT0714",
    "R-model-two": "BT0710",
    "R-model-subtree-noid": "BT0717",
    "R-model-port-digit": "BT0718",
}
# BehaviorTree.CPP refuses it only when it is ticked; the editor reports it earlier.
TOLD_EARLIER = {"R-ok-ite-one-child"}


def cases(name):
    return [json.loads(line) for line in (CASES / f"{name}.jsonl").read_text().splitlines()]


def findings(xml):
    try:
        return check(from_xml(xml, actions=ACTIONS, stubs=False))
    except TranslatorError as error:
        return error.diagnostics


@pytest.mark.parametrize("case", cases("rejects"), ids=lambda case: case["name"])
def test_a_refused_tree_has_an_error(case):
    found = findings(case["xml"])
    if case["name"] in REPAIRED:
        assert REPAIRED[case["name"]] in [item.code for item in found]
    else:
        assert [item for item in found if item.is_error] or not case["rejected_410"]


@pytest.mark.parametrize("case", cases("accepts"), ids=lambda case: case["name"])
def test_what_is_accepted_is_no_error(case):
    errors = [str(item) for item in findings(case["xml"]) if item.is_error]
    assert bool(errors) == (case["name"] in TOLD_EARLIER), errors


@pytest.mark.parametrize("name", ["focused", "random", "timed"])
def test_the_corpus_round_trips_byte_for_byte(name):
    for case in cases(name):
        assert to_xml(from_xml(case["xml"])) == case["xml"], case["name"]


def test_the_corpus_has_no_errors():
    # Entries that a case sets up before loading have no type; seen from the document alone, types may clash.
    for case in cases("focused") + cases("timed"):
        alone = not (case.get("bb") or case.get("init_script") or case.get("extra_xml"))
        errors = [str(item) for item in findings(case["xml"]) if item.is_error]
        assert not errors or not alone, (case["name"], errors)
