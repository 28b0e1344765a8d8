"""Control nodes and decorators are recognised by their syntax: kind, number of children, ports, stubs."""

from __future__ import annotations

import ast

import pytest

from translator import check, from_xml, inspect_action
from translator.action_kind import kind_by_bases, qualified_bases
from translator.catalog import NodeModel, PortModel
from translator.stub import stub_source
from tree_gardener import Status, Tree
from tree_gardener.actions import load_actions

UPDATE = "    def update(self):\n        return self.tick_child(0)\n"


def model(source, name="A"):
    found = inspect_action(source, f"actions/{name}.py")
    return found, [item.code for item in found.diagnostics]


@pytest.mark.parametrize(
    ("imports", "base", "kind"),
    [
        ("from tree_gardener import ControlNode", "ControlNode", "control"),
        ("from tree_gardener import DecoratorNode", "DecoratorNode", "decorator"),
        ("from tree_gardener import ControlNode as Base", "Base", "control"),
        ("import tree_gardener", "tree_gardener.DecoratorNode", "decorator"),
        ("import tree_gardener as tg", "tg.ControlNode", "control"),
        ("import py_trees", "py_trees.composites.Sequence", "control"),
        ("from py_trees import composites", "composites.Selector", "control"),
        ("from py_trees.decorators import Inverter", "Inverter", "decorator"),
        ("import py_trees", "py_trees.behaviour.Behaviour", "action"),
        ("from typing import Sequence", "Sequence", "action"),
    ],
)
def test_the_kind_follows_from_the_base(imports, base, kind):
    found, codes = model(f"{imports}\n\n\nclass A({base}):\n{UPDATE}")
    assert (found.kind, codes) == (kind, [])
    limits = {"control": (1, None), "decorator": (1, 1), "action": (0, 0)}
    assert (found.min_children, found.max_children) == limits[kind]
    assert found.to_json()["children"] == {"min": found.min_children, "max": found.max_children}


@pytest.mark.parametrize(
    ("base", "body", "limits"),
    [
        ("composites.Sequence", "super().__init__(name, True); self.add_children([B('b')])", (0, None)),
        ("composites.Sequence", "super().__init__(name, memory=True, children=[B('b')])", (0, None)),
        ("composites.Sequence", "super().__init__(name, True)", (1, None)),
        ("decorators.Inverter", "super().__init__(name, child=B('b'))", (0, 0)),
    ],
)
def test_a_class_of_py_trees_may_hold_its_children_itself(base, body, limits):
    source = (
        f"import py_trees\n\n\nclass A(py_trees.{base}):\n    def __init__(self, name):\n        {body}\n"
    )
    found, codes = model(source)
    assert ((found.min_children, found.max_children), codes) == (limits, [])
    takes_child = source.replace("name):", "name, child):")
    if "decorators" in base:
        assert model(takes_child)[0].min_children == 1


def test_a_tree_of_such_a_class_alone_has_no_finding():
    made = "child=py_trees.behaviours.Success('b')"
    init = f"    def __init__(self, name):\n        super().__init__(name, {made})\n"
    source = f"import py_trees\n\n\nclass A(py_trees.decorators.Inverter):\n{init}"
    xml = '<root BTCPP_format="4"><BehaviorTree ID="Main"><A/></BehaviorTree></root>'
    found = check(from_xml(xml, actions={"A.py": source.encode()}))
    assert [item.code for item in found if item.is_error] == []


def test_bases_are_named_in_full():
    module = ast.parse("import tree_gardener as t\nclass B(t.ControlNode): pass\nclass A(B, object): pass")
    classes = [node for node in module.body if isinstance(node, ast.ClassDef)]
    bases = qualified_bases(module, classes)
    assert bases == ["tree_gardener.ControlNode", "B", "object"]
    assert kind_by_bases(bases) == ("control", "tree_gardener.ControlNode")


def test_a_base_of_another_file_is_named_by_the_kind():
    found, codes = model(
        f"from shared import Base\n\n\nclass A(Base):\n    NODE_KIND = 'Decorator'\n{UPDATE}"
    )
    assert (found.kind, found.max_children, codes) == ("decorator", 1, [])


@pytest.mark.parametrize(
    ("base", "given", "kind", "expected"),
    [
        ("tree_gardener.DecoratorNode", "Control", "decorator", ["BT0618"]),
        ("tree_gardener.ControlNode", "Decorator", "control", ["BT0618"]),
        ("tree_gardener.ControlNode", "Condition", "control", ["BT0618"]),
        ("tree_gardener.ControlNode", "Control", "control", []),
        ("py_trees.decorators.Inverter", "Control", "decorator", ["BT0618"]),
        ("py_trees.behaviour.Behaviour", "Control", "action", ["BT0618"]),
        ("py_trees.behaviour.Behaviour", "Condition", "condition", []),
    ],
)
def test_a_kind_against_the_base_is_an_error_and_the_base_counts(base, given, kind, expected):
    found, codes = model(f"import x\n\n\nclass A({base}):\n    NODE_KIND = {given!r}\n{UPDATE}")
    assert (found.kind, codes) == (kind, expected)
    assert [item.place.line for item in found.diagnostics] == [5] * len(expected)


def test_a_decorator_takes_no_number_of_children():
    text = "    MIN_CHILDREN = 1\n    MAX_CHILDREN = 3\n"
    found, codes = model(f"from tree_gardener import *\n\n\nclass A(DecoratorNode):\n{text}{UPDATE}")
    assert codes == []  # a starred import names no base
    found, codes = model(
        f"from tree_gardener import DecoratorNode\n\n\nclass A(DecoratorNode):\n{text}{UPDATE}"
    )
    assert (found.min_children, found.max_children, codes) == (1, 1, ["BT0619"])
    assert found.diagnostics[0].place.line == 6


def test_what_a_loop_ignores_is_said():
    text = f"    INPUT_PORTS = {{'k': Port(int)}}\n{UPDATE}"
    found, codes = model(f"from tree_gardener import LoopNode, Port\n\n\nclass A(LoopNode):\n{text}")
    assert codes == ["BT0620", "BT0620"]
    assert [item.message.split()[0] for item in found.diagnostics] == ["INPUT_PORTS", "update"]
    assert {port.name for port in found.ports} == {"queue", "value", "if_empty"}


@pytest.mark.parametrize(
    ("text", "limits", "expected"),
    [
        ("    MIN_CHILDREN = 2\n    MAX_CHILDREN = 2\n", (2, 2), []),
        ("    MIN_CHILDREN: int = 2\n", (2, None), []),
        ("    MAX_CHILDREN = None\n", (1, None), []),
        ("    MIN_CHILDREN = count()\n", (1, None), ["BT0615"]),
        ("    MIN_CHILDREN = 0\n", (1, None), ["BT0615"]),
        ("    MIN_CHILDREN = 3\n    MAX_CHILDREN = 2\n", (3, None), ["BT0615"]),
        ("    MAX_CHILDREN = 'two'\n", (1, None), ["BT0615"]),
    ],
)
def test_the_number_of_children_is_read(text, limits, expected):
    found, codes = model(f"from tree_gardener import ControlNode\n\n\nclass A(ControlNode):\n{text}{UPDATE}")
    assert ((found.min_children, found.max_children), codes) == (limits, expected)


def test_a_control_node_without_update_is_an_error():
    found, codes = model("from tree_gardener import ControlNode\n\n\nclass A(ControlNode):\n    pass\n")
    assert (found.kind, codes) == ("control", ["BT0604"])


@pytest.mark.parametrize(
    ("element", "queue", "value"), [("int", "list[int]", "int"), ("Pose", "any", "any"), (None, "any", "any")]
)
def test_a_loop_has_its_ports_and_needs_no_update(element, queue, value):
    body = f"    ELEMENT = {element}\n" if element else "    pass\n"
    found, codes = model(f"from tree_gardener import LoopNode\n\n\nclass A(LoopNode):\n{body}")
    types = {port.name: (port.direction, port.type, port.required) for port in found.ports}
    assert codes == []
    assert types == {
        "queue": ("inout", queue, True),
        "value": ("output", value, False),
        "if_empty": ("input", "status", False),
    }
    assert (found.kind, found.open, found.max_children) == ("decorator", False, 1)


def test_ports_are_read_from_methods_of_a_class_that_declares_none():
    text = f"{UPDATE}        self.set_output('out', self.get_input('speed'))\n"
    found, _ = model(f"from tree_gardener import ControlNode\n\n\nclass A(ControlNode):\n{text}")
    assert {port.name: port.direction for port in found.ports} == {"out": "output", "speed": "input"}


@pytest.mark.parametrize(
    "type_", ["SharedQueue[int]", "tree_gardener.SharedQueue[int]", "collections.deque[int]"]
)
def test_a_queue_of_numbers_is_a_list_to_the_editor(type_):
    ports = f"    OUTPUT_PORTS = {{'q': Port({type_})}}\n"
    found, codes = model(f"from tree_gardener import *\n\n\nclass A(ControlNode):\n{ports}{UPDATE}")
    assert (found.ports[0].type, codes) == ("list[int]", [])
    other, codes = model(
        "from x import *\n\n\nclass A(B):\n    OUTPUT_PORTS = {'q': Port(SharedQueue[Pose])}\n"
    )
    assert (other.ports[0].type, codes) == ("any", [])


CONTROL = (
    f"from tree_gardener import ControlNode\n\n\nclass Own(ControlNode):\n    MAX_CHILDREN = 2\n{UPDATE}"
)


@pytest.mark.parametrize(("count", "codes"), [(0, ["BT0104"]), (1, []), (2, []), (3, ["BT0104"])])
def test_the_check_counts_the_children_of_an_own_control_node(count, codes, make_project):
    children = {f"c{index}": {"type": "AlwaysSuccess"} for index in range(count)}
    nodes = {"n1": {"type": "Own", "children": list(children)}, **children}
    project = make_project(nodes, actions={"Own": CONTROL})
    assert [item.code for item in check(project) if item.is_error] == codes


@pytest.mark.parametrize(("kind", "base"), [("control", "ControlNode"), ("decorator", "DecoratorNode")])
def test_a_stub_loads_and_always_fails(kind, base):
    ports = {"hz": PortModel("hz", type="double", default="1.0", description="How often.")}
    described = NodeModel("Own", kind, 1, 1, ports)
    for given in (described, None):
        source = stub_source("Own", given, {"hz"}, kind=kind)
        assert f"class Own({base})" in source
        found = inspect_action(source, "actions/Own.py")
        assert (found.kind, found.diagnostics) == (kind, ())
        body = '<BehaviorTree ID="M"><Own hz="2.0"><AlwaysSuccess/></Own></BehaviorTree>'
        xml = f'<root BTCPP_format="4">{body}</root>'
        assert Tree.from_xml(xml, load_actions({"Own": source})).tick_exactly_once() is Status.FAILURE
