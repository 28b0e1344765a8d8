"""The results of Nav2's nodes; the corpus of control nodes compares it with the engine."""

from __future__ import annotations

from translator.action import inspect_action
from translator.check.results.nav2 import ADDED, CONTROLS, is_of_library, of_nav2
from translator.check.results.sets import F, K, R, S
from translator.nav2.sources import nav2_source


def test_a_node_of_the_library_is_known_by_its_source():
    source = nav2_source("RecoveryNode")
    assert is_of_library(inspect_action(source, "actions/RecoveryNode.py"))
    assert not is_of_library(inspect_action(source + "\nx = 1\n", "actions/RecoveryNode.py"))
    assert not is_of_library(inspect_action("class Mine: pass", "actions/Mine.py"))


def test_rules():
    assert of_nav2("RecoveryNode", [S, S | R]) == S
    assert of_nav2("RecoveryNode", [S | F, S | R]) == S | F | R
    assert of_nav2("PipelineSequence", [R, S]) == R | S
    assert of_nav2("PipelineSequence", [F, R]) == F
    assert of_nav2("RoundRobin", [R, R]) == R
    assert of_nav2("RoundRobin", [K, K]) == F | K
    assert of_nav2("NonblockingSequence", [S, R]) == R
    assert of_nav2("PersistentSequence", [R]) == R | S
    assert of_nav2("SingleTrigger", [S]) == S | F
    assert of_nav2("Spin", []) == S | F | R
    assert of_nav2("IsStuck", []) is None


def test_each_rule_is_of_a_node_that_the_library_has():
    assert all(nav2_source(type_) for type_ in (*CONTROLS, *ADDED))
