"""Coverage against hand-made lists."""

from __future__ import annotations

import pytest

from tests.tree_gardener.testing.trees_under_test import BODY, run, suite
from tree_gardener.testing.coverage import Coverage

BUMP = {  # by hand, from the picture of the tree
    "n1": ["ticked", "RUNNING"],
    "n2": ["ticked", "RUNNING", "SUCCESS", "FAILURE", "branch 2 taken", "branch 2 not taken"],
    "n3": ["ticked", "SUCCESS", "FAILURE"],
    "n4": ["ticked", "SUCCESS", "FAILURE"],
    "n5": ["ticked", "RUNNING", "SUCCESS", "FAILURE", "halted while RUNNING"],
    "n6": ["ticked", "RUNNING", "halted while RUNNING"],
}


def test_the_items_of_a_tree_are_those_of_the_list_made_by_hand():
    wanted = suite(BODY).coverage(["Main"]).wanted["Main"]
    assert {node: sorted(items) for node, items in wanted.items() if node != "n1"} == {
        node: sorted(items) for node, items in BUMP.items() if node != "n1"
    }
    assert sorted(wanted["n1"]) == ["FAILURE", "RUNNING", "ticked"]  # Turn is not known to run without end


def covered(body, *tests):
    of = suite(body)
    coverage = of.coverage(["Main"])
    for test in tests:
        coverage.add_seen(run(test, of).seen)
    return coverage


@pytest.mark.parametrize(
    ("body", "one", "more", "missing"),
    [
        ('<Near _bts_id="a"/>', {"Near": "SUCCESS"}, {"Near": "FAILURE"}, {"FAILURE"}),
        (
            '<Fallback _bts_id="f"><Near _bts_id="a"/><AlwaysSuccess _bts_id="b"/></Fallback>',
            {"Near": "SUCCESS"},
            {"Near": "FAILURE"},
            {"FAILURE", "ticked", "SUCCESS", "branch 2 taken"},
        ),
        (
            '<IfThenElse _bts_id="i"><Near _bts_id="a"/><AlwaysSuccess _bts_id="b"/>'
            '<AlwaysSuccess _bts_id="c"/></IfThenElse>',
            {"Near": "SUCCESS"},
            {"Near": "FAILURE"},
            {"FAILURE", "ticked", "SUCCESS", "branch 3 taken", "branch 2 not taken"},
        ),
        (
            '<ReactiveSequence _bts_id="r"><Near _bts_id="a"/><Drive _bts_id="d"/></ReactiveSequence>',
            {"Near": "SUCCESS", "Drive": "RUNNING"},
            {"Near": ["SUCCESS", "FAILURE"], "Drive": "RUNNING"},
            {"FAILURE", "halted while RUNNING"},
        ),
    ],
)
def test_what_is_missing_is_reached_by_another_test(body, one, more, missing):
    expect = [{"at": 1, "ticked": {"Near": 1}}]
    first = {"doubles": one, "repeat": True, "expect": expect}
    coverage = covered(body, first)
    assert {item for _, _, item in coverage.missing()} == missing
    assert coverage.share < 1
    assert covered(body, first, {**first, "doubles": more}).missing() == []


def test_conditions_count_true_and_false():
    body = '<Sequence _bts_id="s"><Near _bts_id="a" _skipIf="x &gt; 1" _onSuccess="x := 2"/></Sequence>'
    test = {
        "blackboard": {"x": 0},
        "doubles": {"Near": "SUCCESS"},
        "ticks": 1,
        "expect": [{"at": 1, "root": "SUCCESS"}],
    }
    missing = {(node, item) for _, node, item in covered(body, test).missing()}
    assert missing == {
        ("a", "_skipIf true"),
        ("a", "FAILURE"),
        ("a", "SKIPPED"),
        ("s", "FAILURE"),
        ("s", "SKIPPED"),
    }
    again = {**test, "ticks": 2, "repeat": True}
    assert ("a", "_skipIf true") not in {(node, item) for _, node, item in covered(body, again).missing()}


def test_subtrees_count_once_for_all_callers():
    calls = "".join(f'<SubTree ID="Part" name="{name}" _bts_id="{name}"/>' for name in "xy")
    body = f'<Sequence _bts_id="s">{calls}</Sequence>'
    of = suite(body, '<BehaviorTree ID="Part"><Near _bts_id="p"/></BehaviorTree>')
    coverage = of.coverage(["Main", "Part"])
    assert list(coverage.wanted["Part"]) == ["p"]
    test = {
        "doubles": {"x/*": "SUCCESS", "y/*": "FAILURE"},
        "ticks": 1,
        "expect": [{"at": 1, "root": "FAILURE"}],
    }
    coverage.add_seen(run(test, of).seen)
    assert [item for tree, _, item in coverage.missing() if tree == "Part"] == []


def test_the_document_says_shares_and_items():
    coverage = covered(
        '<Near _bts_id="a"/>', {"doubles": {"Near": "SUCCESS"}, "expect": [{"at": 1, "root": "SUCCESS"}]}
    )
    document = coverage.to_json()
    assert document["share"] == pytest.approx(2 / 3, abs=1e-6)
    assert document["trees"]["Main"]["nodes"]["a"] == {
        "name": "Near",
        "type": "Near",
        "items": {"ticked": True, "SUCCESS": True, "FAILURE": False},
    }


def test_nothing_to_cover_is_covered():
    assert Coverage().share == 1
    assert Coverage().missing() == []
