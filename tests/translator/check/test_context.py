"""The context of the checks: places of findings, and how severe they are."""

from __future__ import annotations

from translator.check.context import Context, located


def test_an_unknown_value_in_a_tree_that_never_runs_is_a_warning(make_project):
    project = make_project({"n1": {"type": "AlwaysSuccess"}}, trees={"Other": {"n1": {"type": "Act"}}})
    context = Context(project)
    tree = project.trees["Other"]
    values = {"port": "speed", "value": "x", "wanted": "a number"}
    context.report("BT0204", tree, tree.nodes["n1"], "speed", **values)
    context.report("BT0204", project.trees["MainTree"], None, "speed", **values)
    assert [item.is_error for item in context.found] == [False, True]


def test_a_finding_at_a_node_gets_its_line_in_the_file(make_project):
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    context = Context(project)
    tree = project.trees["MainTree"]
    context.report("BT0105", tree, tree.nodes["n1"], node="n1", type="AlwaysSuccess")
    [found] = located(context.found, project)
    line = project.files["trees/MainTree.json"].splitlines()[0].decode()
    assert found.place.line == 1
    assert line[(found.place.column or 0) - 1 :].startswith('"n1"')
