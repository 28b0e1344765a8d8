"""The predictions of the checker hold in the engine, for random trees and for the conformance corpus."""

from __future__ import annotations

import json

from tests.budget import count
from tests.translator.check.results.engine import compare, corpus, corpus_observed
from translator import load
from translator.check.context import Context
from translator.check.results import interpret
from translator.check.results.sets import ALL, F, K, R, S
from translator.tree import callees_first

COUNT = count("checker_soundness")


def test_random_trees_return_nothing_else():
    found = {seed: missed for seed in range(1, COUNT + 1) if (missed := compare(seed))}
    assert not found, next(iter(found.items()))


def test_a_tree_whose_tick_never_ends_is_compared_until_then():
    assert compare(6988) == []


def test_the_comparison_notices_a_wrong_rule(monkeypatch):
    from translator.check.results import controls

    monkeypatch.setitem(controls.RULES, "Fallback", lambda _node, _children: S)
    assert any(compare(seed) for seed in range(30))


def test_the_conformance_corpus_returns_nothing_else_and_ticks_nothing_that_is_never_reached():
    cases = list(corpus(every=max(1, 6000 // COUNT)))
    assert len(cases) > 100
    wrong = [(case["name"], missed) for case in cases if (missed := corpus_observed(case))]
    assert wrong == []


def project(nodes, *, trees=None, actions=None, **settings):
    files = {"project.json": json.dumps({"format": "bt-studio/project", "version": 1, **settings}).encode()}
    for tree, rows in {"MainTree": nodes, **(trees or {})}.items():
        document = {"format": "bt-studio/diagram", "version": 1, "id": tree, "root": "r", "nodes": rows}
        files[f"trees/{tree}.json"] = json.dumps(document).encode()
    files |= {f"actions/{name}.py": source.encode() for name, source in (actions or {}).items()}
    return load(files)


def results(given):
    return interpret(given, callees_first(given.trees))


def action(body, extra=""):
    return (
        "import py_trees\nfrom tree_gardener import Status\n\n\n"
        f"class Act(py_trees.behaviour.Behaviour):\n{extra}    def update(self):\n        {body}\n"
    )


def test_a_subtree_returns_what_its_root_can():
    found = results(
        project(
            {"r": {"type": "SubTree", "tree": "B"}},
            trees={"B": {"r": {"type": "Inverter", "children": ["a"]}, "a": {"type": "AlwaysSuccess"}}},
        )
    )
    assert found.may["MainTree"]["r"] == F


def test_trees_that_call_each_other_in_a_ring_can_return_anything():
    found = results(
        project(
            {"r": {"type": "SubTree", "tree": "B"}},
            trees={"B": {"r": {"type": "SubTree", "tree": "MainTree"}}},
        )
    )
    assert ALL in (found.may["MainTree"]["r"], found.may["B"]["r"])


def test_a_disabled_node_is_skipped_and_an_unknown_one_returns_anything():
    rows = {
        "r": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "AlwaysFailure", "disabled": True},
        "b": {"type": "Unknown"},
    }
    found = results(project(rows))
    assert (found.may["MainTree"]["a"], found.may["MainTree"]["b"]) == (K, ALL)
    assert found.named["MainTree"]["b"] == 0


def conditions(**given):
    return results(project({"r": {"type": "AlwaysSuccess", "conditions": given}})).may["MainTree"]["r"]


def test_pre_conditions_decide_results_and_constant_ones_do_so_always():
    assert conditions(_failureIf="x", _skipIf="y") == S | F | K
    assert conditions(_while="x") == S | K
    assert conditions(_skipIf="true") == K
    assert conditions(_failureIf="x", _skipIf="1") == F | K
    assert conditions(_while="false") == K
    assert conditions(_failureIf="false", _while=" true ") == S
    assert conditions(_onSuccess="x := 1") == S


def act(source, **settings):
    found = results(project({"r": {"type": "Act"}}, actions={"Act": source}, **settings))
    return found.may["MainTree"]["r"], found.named["MainTree"]["r"]


def test_actions_return_what_their_python_says():
    plain = action("return Status.SUCCESS if self.x else Status.RUNNING")
    assert act(plain) == (S | R, S | R)
    assert act(plain, on_error="failure") == (S | R | F, S | R)
    assert act(action("return self.done() or Status.RUNNING")) == (ALL, 0)
    assert act(action("return self.done()", "    RETURNS = {'FAILURE'}\n")) == (F, F)
    stub = action("return Status.FAILURE", '    """bt-studio: to be written."""\n\n')
    assert act(stub) == (ALL, 0)
    assert act(action("return self.done()", "    NODE_KIND = 'Condition'\n")) == (ALL & ~R, 0)


def test_a_condition_that_rests_may_count_what_it_skipped_before():
    rows = {
        "r": {"type": "WhileDoElse", "children": ["a", "b"]},
        "a": {"type": "Sequence", "children": ["c", "d"]},
        "b": {"type": "AlwaysSuccess"},
        "c": {"type": "AlwaysSuccess", "conditions": {"_skipIf": "x"}},
        "d": {"type": "ScriptCondition", "ports": {"code": "y"}},
    }
    assert results(project(rows)).may["MainTree"]["a"] == S | F | K


def test_the_context_computes_them_once():
    context = Context(project({"r": {"type": "AlwaysSuccess"}}))
    assert context.results is context.results
    assert context.results.of(context.project.trees["MainTree"], "r") == S
