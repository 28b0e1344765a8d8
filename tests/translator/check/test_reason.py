"""The path of a reason."""

from __future__ import annotations

from translator.check.context import Context
from translator.check.reason import LONGEST, because, step

LEAF = {"type": "AlwaysSuccess"}


def test_it_leads_to_the_child_that_decides(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": LEAF,
        "b": {"type": "Fallback", "children": ["c"]},
        "c": {"type": "AlwaysFailure"},
    }
    context = Context(make_project(nodes))
    tree = context.project.trees["MainTree"]
    path = because(context, tree, (tree.nodes["n1"],))
    assert [item.node for item in path] == ["n1", "b", "c"]
    assert str(step(context, tree, tree.nodes["c"])) == "MainTree/AlwaysFailure (FAILURE)"


def test_it_ends_where_several_decide_and_is_never_long(make_project):
    condition = {"type": "ScriptCondition", "ports": {"code": "x"}}
    nodes = {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": condition, "b": condition}
    nodes |= {"d0": {"type": "Inverter", "children": ["d1"]}}
    nodes |= {f"d{index}": {"type": "Inverter", "children": [f"d{index + 1}"]} for index in range(1, 20)}
    nodes |= {"d20": LEAF}
    context = Context(
        make_project(
            nodes, trees={"Deep": {"n1": {"type": "Inverter", "children": ["d0"]}, **nodes_of(nodes)}}
        )
    )
    tree = context.project.trees["MainTree"]
    assert len(because(context, tree, (tree.nodes["n1"],))) == 1
    deep = context.project.trees["Deep"]
    assert len(because(context, deep, (deep.nodes["n1"],))) == LONGEST


def nodes_of(nodes):
    return {key: row for key, row in nodes.items() if key.startswith("d")}
