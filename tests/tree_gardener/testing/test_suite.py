"""A test drives the real tree; only what is below its leaves is doubled."""

from __future__ import annotations

import pytest

from tests.tree_gardener.testing.trees_under_test import read, run, sentences, suite
from tree_gardener.testing import suite as suites

ALL = {"Near": "FAILURE", "Turn": "RUNNING", "Drive": "RUNNING"}


def test_a_test_that_holds_passes():
    result = run({"doubles": ALL, "expect": [{"at": "1..10", "node": "Drive", "status": "RUNNING"}]})
    assert result.passed
    assert (result.ticks, result.root) == (10, "RUNNING")


def test_a_failure_names_test_tick_node_wanted_got_and_path():
    expect = [{"at": 3, "node": "Drive", "status": "IDLE"}]
    result = run({"doubles": ALL, "tick_hz": 10, "expect": expect})
    [failure] = result.failures
    assert (result.name, failure.tick, failure.time_s) == ("t", 3, 0.2)
    assert (failure.node, failure.tree, failure.node_id) == ("Drive::6", "Main", "n6")
    assert (failure.wanted, failure.got) == ("IDLE", "RUNNING")
    assert failure.path == (("main", "RUNNING"), ("Drive", "RUNNING"))


def test_a_leaf_without_a_double_fails_when_it_is_first_ticked():
    doubles = {"Near": ["FAILURE", "FAILURE", "SUCCESS"], "Drive": "RUNNING"}
    result = run({"doubles": doubles, "expect": [{"at": "end", "root": "RUNNING"}]})
    [failure] = result.failures
    assert failure.tick == 3
    assert failure.message == "the leaf is ticked and has no double: write one for Turn, or `Turn: real`"


def test_results_come_one_a_tick_and_the_last_one_stays():
    doubles = {**ALL, "Near": ["SUCCESS", "SUCCESS", "FAILURE"]}
    expect = [
        {"at": "1..2", "node": "Turn", "status": "RUNNING"},
        {"at": "3..10", "node": "Drive", "status": "RUNNING"},
        {"at": 3, "halted": ["Turn"]},
        {"at": "end", "ticked": {"Near": 10, "Turn": 2, "Drive": 8}},
    ]
    assert run({"doubles": doubles, "expect": expect}).passed


def test_time_is_that_of_the_test_and_outputs_come_with_the_result():
    body = '<Sequence><Turn angle="{angle}"/><Sleep msec="500"/></Sequence>'
    turn = {"status": "RUNNING", "for_s": 0.3, "then": "SUCCESS", "outputs": {"angle": 1.57}}
    expect = [
        {"at": "1..3", "node": "Turn", "status": "RUNNING", "blackboard": {"angle": None}},
        {"at": 4, "node": "Turn", "result": "SUCCESS", "blackboard": {"angle": 1.57}},
        {"at": 8, "root": "RUNNING"},
        {"at": 9, "root": "SUCCESS"},
    ]
    result = run({"doubles": {"Turn": turn}, "tick_hz": 10, "ticks": 20, "expect": expect}, suite(body))
    assert result.failures == ()
    assert result.ticks == 9  # a tree that ended is not ticked again


def test_a_tree_that_ended_is_ticked_again_if_wanted():
    test = {
        "doubles": {"Drive": "SUCCESS"},
        "repeat": True,
        "expect": [{"at": "end", "ticked": {"Drive": 10}}],
    }
    assert run(test, suite("<Drive/>")).ticks == 10


def test_scripts_conditions_and_the_blackboard_are_real():
    body = '<Sequence><Script code="count := count + 1"/><Drive _skipIf="count &lt; 3"/></Sequence>'
    expect = [{"at": "end", "blackboard": {"count": 3}, "ticked": {"Drive": 3}}]
    test = {
        "blackboard": {"count": 0},
        "doubles": {"Drive": "SUCCESS"},
        "ticks": 3,
        "repeat": True,
        "expect": expect,
    }
    assert sentences(test, suite(body)) == []


def test_the_value_of_the_blackboard_is_that_of_the_port():
    body = '<Repeat num_cycles="{cycles}"><Drive/></Repeat>'
    test = {
        "blackboard": {"cycles": 2},
        "doubles": {"Drive": "SUCCESS"},
        "expect": [{"at": 2, "root": "SUCCESS"}],
    }
    assert sentences(test, suite(body)) == []
    wrong = sentences({**test, "blackboard": {"cycles": "many"}}, suite(body))
    assert wrong[0].startswith("blackboard: entry 'cycles' holds a whole number")


def test_ports_of_the_tree_have_their_defaults():
    body = '<Repeat num_cycles="{cycles}"><Drive/></Repeat>'
    of = suite(body, ports={"Main": {"cycles": "3"}})
    assert sentences({"doubles": {"Drive": "SUCCESS"}, "expect": [{"at": 3, "root": "SUCCESS"}]}, of) == []


def test_an_error_of_a_node_fails_the_test_at_its_place():
    result = run({"expect": [{"at": 1, "root": "SUCCESS"}]}, suite('<Script code="a = 1" _bts_id="n1"/>'))
    [failure] = result.failures
    assert (failure.tick, failure.node_id) == (1, "n1")
    assert "in the script 'a = 1'" in failure.message


def test_doubles_are_found_by_path_then_name_then_type_then_pattern():
    body = '<Sequence><Drive name="a"/><Drive name="b"/><Drive name="c"/><Turn/></Sequence>'
    doubles = {"*": "RUNNING", "Drive": "SUCCESS", "b": "FAILURE"}
    expect = [{"at": 1, "node": "a", "result": "SUCCESS"}, {"at": 1, "node": "b", "result": "FAILURE"}]
    assert sentences({"doubles": doubles, "ticks": 1, "expect": expect}, suite(body)) == []


def test_a_value_of_the_blackboard_is_bounded(monkeypatch):
    monkeypatch.setattr(suites, "MAX_VALUE_BYTES", 1000)
    body = '<Script code="a := a .. a"/>'
    test = {
        "blackboard": {"a": "xyz"},
        "repeat": True,
        "ticks": 20,
        "expect": [{"at": "end", "root": "SUCCESS"}],
    }
    [said] = sentences(test, suite(body))
    assert said.startswith("tick 9 (0.4 s)")
    assert "the entry 'a' would hold more than" in said


def test_a_control_node_of_the_project_is_left_out_unless_it_is_real():
    of = suite("<Mine><Drive/></Mine>")
    test = {"doubles": {"Drive": "SUCCESS"}, "expect": [{"at": 1, "root": "SUCCESS"}]}
    assert "Mine is Python of the project, which tests leave out" in sentences(test, of)[0]
    source = (
        "from tree_gardener import ControlNode, Status\n"
        "class Mine(ControlNode):\n"
        "    def update(self):\n"
        "        return self.tick_child(0)\n"
    )
    of = suite("<Mine><Drive/></Mine>", sources={"Mine": source})
    assert sentences({**test, "doubles": {"Mine": "real", "Drive": "SUCCESS"}}, of) == []


REAL = """
import py_trees
class Turn(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        {setup}
    def update(self):
        return py_trees.common.Status.SUCCESS
"""


def test_a_real_leaf_runs_its_own_python_beside_doubles():
    of = suite(
        "<Sequence><Turn/><Drive/></Sequence>", sources={"Turn": REAL.format(setup="pass"), "Drive": "1/0"}
    )
    test = {
        "doubles": {"Turn": "real", "Drive": "RUNNING"},
        "expect": [{"at": 1, "node": "Turn", "result": "SUCCESS"}],
    }
    assert sentences(test, of) == []


def test_a_real_leaf_that_needs_ros_fails_with_a_sentence():
    of = suite("<Turn/>", sources={"Turn": REAL.format(setup="kwargs['node'].create_publisher(1, 2, 3)")})
    [said] = sentences({"doubles": {"Turn": "real"}, "expect": [{"at": 1, "root": "SUCCESS"}]}, of)
    assert "Turn needs ROS, which behaviour tests do not have" in said


def test_no_python_of_the_project_runs_unless_it_may(tmp_path):
    """The document brings a source whose import writes a file; doubled or refused, it never runs."""
    planted = tmp_path / "planted"
    head = f"import pathlib\npathlib.Path({str(planted)!r}).touch()\n"
    code = head + "import py_trees\nclass Turn(py_trees.behaviour.Behaviour): pass\n"
    more = f'<Code><Action name="Turn"><![CDATA[{code}]]></Action></Code>'
    of = suite("<Turn/>", more)
    assert run({"doubles": {"Turn": "SUCCESS"}, "expect": [{"at": 1, "root": "SUCCESS"}]}, of).passed
    [said] = sentences({"doubles": {"Turn": "real"}}, of)
    assert "Python of the project does not run here" in said
    assert not planted.exists()
    assert (
        not suite("<Turn/>", more, sources={"Turn": code})
        .run(read({"doubles": {"Turn": "real"}})[0][0])
        .passed
    )
    assert planted.exists()  # so the planted source would have been seen


@pytest.mark.parametrize("ticks", [1, 100_000])
def test_the_largest_test_ends(ticks):
    assert (
        run(
            {
                "doubles": {"Drive": "RUNNING"},
                "ticks": ticks,
                "expect": [{"at": "end", "ticked": {"Drive": ticks}}],
            },
            suite("<Drive/>"),
        ).ticks
        == ticks
    )
