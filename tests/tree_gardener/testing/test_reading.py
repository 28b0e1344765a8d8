"""Whatever is wrong with a file of tests is said with its place; nothing is guessed."""

from __future__ import annotations

import pytest

from tests.tree_gardener.testing.trees_under_test import read, suite
from tree_gardener.status import Status
from tree_gardener.testing import read_tests
from tree_gardener.testing.cases import Step

SOUND: dict = {"name": "t", "ticks": 3, "expect": [{"at": 1, "root": "RUNNING"}]}


def problems(document, place=None):
    return [f"{found.line} {found.code} {found.message}" for found in read_tests(document, "f", place)[1]]


def test_a_whole_test_is_read():
    [case], found = read(
        {
            "tree": "Main",
            "blackboard": {"speed": 0.3},
            "doubles": {
                "Near": ["SUCCESS", {"status": "FAILURE", "times": 3}],
                "Turn*": {"status": "RUNNING", "for_s": 2, "then": "SUCCESS", "outputs": {"angle": 1.57}},
                "Drive": "real",
            },
            "tick_hz": 20,
            "expect": [
                {"at": "1..4", "node": "Drive", "status": "IDLE"},
                {"eventually": {"root": "SUCCESS"}, "within_s": 3},
                {"never": {"root": "FAILURE", "while": {"node": "Turn", "status": "RUNNING"}}},
                {"at": "end", "blackboard": {"done": True}, "halted": "Turn", "ticked": {"Near": 60}},
            ],
        }
    )
    assert found == []
    near, turn, drive = case.doubles
    assert near.steps == (Step(Status.SUCCESS), Step(Status.FAILURE, {}, 3))
    assert (turn.for_s, turn.steps[1].outputs) == (2.0, {"angle": 1.57})
    assert drive.real
    assert case.uses_real
    during, eventually, never, end = case.expect
    assert (during.first, during.last) == (1, 4)
    assert eventually.within_s == 3.0
    assert never.claim.during.node == "Turn"
    assert (end.first, end.claim.halted, end.claim.ticked) == (None, ("Turn",), {"Near": 60})


def test_the_time_of_a_test_can_be_given_in_seconds():
    assert read({"ticks": 1})[0][0].ticks == 1
    content: dict = {
        "format": "bt-studio/test",
        "version": 1,
        "tests": [{**SOUND, "for_s": 0.25, "tick_hz": 20}],
    }
    del content["tests"][0]["ticks"]
    assert read_tests(content)[0][0].ticks == 5


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"tick": 3}, "TG901 the key 'tick' is not known here"),
        ({"expect": []}, "TG906 the test 't' expects nothing"),
        ({"doubles": {"Near": [{"at": 2, "status": "SUCCESS"}, "FAILURE"]}}, "TG902 the ticks of a list"),
        (
            {"doubles": {"Near": [{"at": 2, "status": "SUCCESS"}, {"at": 1, "status": "SUCCESS"}]}},
            "TG902 the ticks of a list",
        ),
        ({"doubles": {"Near": [{"at": 2, "times": 2, "status": "SUCCESS"}]}}, "TG902 an item has either"),
        ({"doubles": {"Near": [{"at": 0, "status": "SUCCESS"}]}}, "TG902 a whole number from 1"),
        ({"ticks": 0}, "TG902 a whole number from 1 to 100000"),
        ({"ticks": 100_001}, "TG902 a whole number from 1 to 100000"),
        ({"ticks": True}, "TG902 a whole number"),
        ({"for_s": 3}, "TG902 the test needs either ticks or for_s"),
        ({"tick_hz": 0}, "TG902 a number above 0"),
        ({"tick_hz": float("nan")}, "TG902 a number above 0"),
        ({"name": 3}, "TG902 a name is needed"),
        ({"repeat": "yes"}, "TG902 true or false"),
        ({"doubles": ["Near"]}, "TG902 names with values"),
        ({"doubles": {"Near": []}}, "TG902 an empty list"),
        ({"doubles": {"Near": "MAYBE"}}, "TG904 'MAYBE' is no status"),
        ({"doubles": {"Near": "IDLE"}}, "TG904 'IDLE' is no status"),
        ({"doubles": {"Near": {"status": "RUNNING", "for_s": 2}}}, "TG902 for_s and then belong together"),
        ({"doubles": {"Near": {"status": "RUNNING", "until": 2}}}, "TG901 the key 'until'"),
        ({"expect": [{"node": "Near", "status": "IDLE"}]}, "TG902 an expectation has one of at"),
        ({"expect": [{"at": 1, "never": {}}]}, "TG902 an expectation has one of at"),
        ({"expect": [{"at": 1}]}, "TG902 the expectation says nothing"),
        ({"expect": [{"at": 0, "root": "RUNNING"}]}, "TG902 a whole number from 1"),
        ({"expect": [{"at": "9..3", "root": "RUNNING"}]}, "TG902 '9..3' is no range"),
        ({"expect": [{"at": 1, "node": "Near"}]}, "TG902 the expectation says nothing"),
        ({"expect": [{"at": 1, "status": "IDLE"}]}, "TG902 node goes together"),
        ({"expect": [{"at": 1, "node": "Near", "status": "SKIPPED"}]}, "TG904 'SKIPPED' is no status"),
        ({"expect": [{"at": 1, "root": "RUNNING", "within_s": 1}]}, "TG901 the key 'within_s'"),
    ],
)
def test_what_is_wrong_is_said(change, said):
    cases, found = read(change)
    assert cases == []
    assert said in f"{found[0].code} {found[0].message}"


def test_a_near_miss_is_suggested():
    assert read({"expext": []})[1][0].hint == "did you mean expect?"


def test_a_name_may_be_used_once_in_a_file():
    content = {"format": "bt-studio/test", "version": 1, "tests": [SOUND, SOUND]}
    cases, found = read_tests(content)
    assert len(cases) == 1
    assert "two tests are named 't'" in found[0].message


def test_one_wrong_test_does_not_take_the_others_along():
    content = {"format": "bt-studio/test", "version": 1, "tests": [{"name": "x"}, SOUND]}
    cases, found = read_tests(content)
    assert [case.name for case in cases] == ["t"]
    assert len(found) == 1


@pytest.mark.parametrize(
    "content", [None, [], 3, {"format": "x"}, {"format": "bt-studio/test", "version": True}]
)
def test_other_documents_are_refused(content):
    assert len(problems(content)) == 1


def test_a_problem_has_the_place_of_the_part():
    content = {"format": "bt-studio/test", "version": 1, "tests": [{**SOUND, "ticks": -1}]}
    places = {("tests", 0, "ticks"): (7, 3)}
    assert problems(content, lambda path: places.get(path, (1, 1))) == [
        "7 TG902 a whole number from 1 to 100000 is needed here"
    ]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"tree": "Nowhere"}, "TG907 the tree of 't'"),
        ({"doubles": {"Far": "SUCCESS"}}, "TG905 'Far' matches no leaf"),
        ({"doubles": {"Inverter": "SUCCESS"}}, "TG905 'Inverter' is a node of the engine"),
        ({"doubles": {"Near": "RUNNING"}}, "TG904 Near is a condition and cannot return RUNNING"),
        (
            {"doubles": {"Turn": {"status": "SUCCESS", "outputs": {"speed": 1}}}},
            "TG905 Turn has no output 'speed'",
        ),
        ({"expect": [{"at": 1, "node": "Far", "status": "IDLE"}]}, "TG905 there is no node 'Far'"),
        ({"expect": [{"at": "end", "ticked": {"Far": 1}}]}, "TG905 there is no node 'Far'"),
        (
            {"expect": [{"never": {"root": "FAILURE", "while": {"node": "Far", "status": "IDLE"}}}]},
            "no node 'Far'",
        ),
    ],
)
def test_names_are_checked_against_the_tree(change, said):
    cases, found = read(change, suite())
    assert cases == []
    assert said in f"{found[0].code} {found[0].message}"


def test_a_name_of_several_nodes_must_be_made_clear():
    twice = suite('<Sequence><Drive name="a"/><Drive name="b"/></Sequence>')
    _, found = read({"expect": [{"at": 1, "node": "Drive", "status": "IDLE"}]}, twice)
    assert "means several nodes" in found[0].message
    assert "'a', 'b'" in found[0].hint
    assert read({"expect": [{"at": 1, "node": "a", "status": "IDLE"}]}, twice)[1] == []


def test_a_pattern_leaves_the_kinds_alone_that_an_earlier_line_has():
    doubles = {"Near": "SUCCESS", "*": "RUNNING"}
    assert read({"doubles": doubles}, suite())[1] == []
