"""The uses of keys by nodes and trees."""

from __future__ import annotations

from translator.check.context import Context
from translator.check.uses import is_local, outer_name
from translator.tree import Node

CALL = {"type": "SubTree", "tree": "Other", "ports": {"in": "{out}", "given": "5"}}


def keys(project, tree="MainTree"):
    return Context(project).keys[tree]


def test_ports_scripts_and_undeclared_ports(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b", "c", "d"]},
        "a": {"type": "Act", "ports": {"speed": "{s}", "result": "{r}", "counter": "{n}"}},
        "b": {"type": "Script", "ports": {"code": "x := y"}, "conditions": {"_skipIf": "z"}},
        "c": {"type": "Open", "ports": {"any": "{o}"}},
        "d": {"type": "SetBlackboard", "ports": {"value": "{v}", "output_key": "k"}},
    }
    found = keys(make_project(nodes))
    assert set(found.read) >= {"s", "n", "y", "z", "o", "v"}
    assert set(found.written) >= {"r", "n", "x", "o", "k"}
    assert found.surely >= {"r", "n", "x", "k"}
    assert "o" not in found.surely
    assert found.parts["b"].reads == [("z", "_skipIf"), ("y", "code")]
    assert found.parts["a"].reads == [("s", "speed")]
    assert "n1" not in found.parts


def test_a_call_uses_what_its_tree_uses_under_its_own_names(make_project):
    other = {"n1": {"type": "Script", "ports": {"code": "in := own + given"}}}
    project = make_project({"n1": CALL}, trees={"Other": other})
    found = keys(project)
    assert (set(found.read), set(found.written), found.surely) == (set(), {"out"}, {"out"})
    context = Context(project)
    tree = project.trees["Other"]
    assert [is_local(context, tree, key) for key in ("own", "in", "given", "@own")] == [
        True,
        False,
        False,
        False,
    ]


def test_names_of_the_caller():
    plain = Node("n", "SubTree", tree="T", ports={"a": "{b}", "c": "text"})
    shared = Node("n", "SubTree", tree="T", attributes={"_autoremap": "true"})
    assert [outer_name(plain, key) for key in ("a", "c", "d", "@g")] == ["b", None, None, "@g"]
    assert [outer_name(shared, key) for key in ("d", "_d")] == ["d", None]
