"""Actions are read by their syntax alone: class, ports, documentation, imports; nothing is ever run."""

from __future__ import annotations

import pytest

from translator import inspect_action

HEAD = "import py_trees\nfrom tree_gardener.ports import Port\n\n\nclass A(py_trees.behaviour.Behaviour):\n"
BODY = "\n    def update(self):\n        return None\n"


def ports(text):
    model = inspect_action(HEAD + text + BODY, "actions/A.py")
    return {port.name: port for port in model.ports}, [item.code for item in model.diagnostics]


@pytest.mark.parametrize(
    ("declared", "type_", "default"),
    [
        ("Port(float, default=0.3)", "double", "0.3"),
        ("Port(int, default=-2)", "int", "-2"),
        ("Port(str, default='a b')", "string", "a b"),
        ("Port(bool, default=True)", "bool", "true"),
        ("Port('double')", "double", None),
        ("Port(list[float], default=[1.0, 2.5])", "list[double]", "1.0;2.5"),
        ("Port(float, default='{key}')", "double", "{key}"),
        ("Port(float, default='{=}')", "double", "{=}"),
        ("Port()", "any", None),
        ("Port(Any)", "any", None),
        ("Port(PoseStamped)", "any", None),
        ("Port(type=float)", "double", None),
        ("ports.Port(float)", "double", None),
        ("Port(float, default=SPEED)", "double", None),
        ("PortInformation(int, False, 'how many', 3)", "int", "3"),
    ],
)
def test_types_and_defaults(declared, type_, default):
    found, codes = ports(f"    INPUT_PORTS = {{'p': {declared}}}\n")
    assert codes == []
    assert (found["p"].type, found["p"].default) == (type_, default)


def test_directions_required_and_description():
    found, _ = ports(
        "    INPUT_PORTS = {'a': Port(int, required=True, description='An a')}\n"
        "    OUTPUT_PORTS: dict = {'b': Port(int)}\n    INOUT_PORTS = {'c': Port(int)}\n"
    )
    assert [(port.direction, port.required) for port in found.values()] == [
        ("input", True),
        ("output", False),
        ("inout", False),
    ]
    assert found["a"].description == "An a"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("    INPUT_PORTS = make()\n", "BT0610"),
        ("    INPUT_PORTS = {name: Port(int)}\n", "BT0610"),
        ("    INPUT_PORTS = {**OTHERS}\n", "BT0610"),
        ("    INPUT_PORTS = {'p': 5}\n", "BT0611"),
        ("    INPUT_PORTS = {'p': make()}\n", "BT0611"),
        ("    INPUT_PORTS = {'p': Port(lambda: int)}\n", "BT0612"),
        ("    NODE_KIND = 'Composite'\n", "BT0606"),
        ("    INPUT_PORTS = {'name': Port(int)}\n", "BT0209"),
        ("    OUTPUT_PORTS = {'_x': Port(int)}\n", "BT0209"),
        ("    INOUT_PORTS = {'1p': Port(int)}\n", "BT0209"),
    ],
)
def test_unreadable_source_is_reported_with_its_line(text, code):
    model = inspect_action(HEAD + text + BODY, "actions/A.py")
    (found,) = model.diagnostics
    assert (found.code, found.place.line) == (code, 6)


def test_kind_documentation_imports_and_line():
    model = inspect_action(HEAD + '    """Sees."""\n    NODE_KIND = "Condition"\n' + BODY, "actions/A.py")
    assert (model.kind, model.doc, model.open, model.line) == ("condition", "Sees.", True, 5)
    assert [(item.module, item.line) for item in model.imports] == [
        ("py_trees", 1),
        ("tree_gardener.ports", 2),
    ]
    assert model.to_json()["imports"] == ["py_trees", "tree_gardener.ports"]


def test_open_action_lists_the_ports_that_it_asks_for():
    source = HEAD + (
        "    def update(self):\n"
        "        speed = tree_tools.get_port_content(self.ports['speed'])\n"
        "        extra = self.ports.get('extra', '')\n"
        "        tree_tools.set_port_content(self.ports['pos'], 1)\n"
    )
    model = inspect_action(source, "actions/A.py")
    assert model.open
    assert {port.name: port.direction for port in model.ports} == {
        "speed": "input",
        "extra": "input",
        "pos": "output",
    }


def test_bases_in_the_same_file_are_followed():
    source = (
        "import py_trees\nclass Base(py_trees.behaviour.Behaviour):\n    INPUT_PORTS = {'p': Port(int)}\n"
        "    def update(self): pass\nclass A(Base):\n    pass\n"
    )
    model = inspect_action(source, "actions/A.py")
    assert model.diagnostics == ()
    assert [port.name for port in model.ports] == ["p"]


def test_base_of_another_module_may_be_anything():
    assert inspect_action("from lib import Base\nclass A(Base): pass\n", "actions/A.py").diagnostics == ()


@pytest.mark.parametrize(
    "source",
    [
        "class A(",
        "\x00",
        "(" * 5000,
        "a = " + "-" * 100_000 + "1",
        "x" * 3_000_000,
        "class A:\n\tdef f(self):\n        pass",
        'raise SystemExit("run!")\n',
        "import os; os.abort()\n",
    ],
)
def test_hostile_sources_are_neither_run_nor_fatal(source):
    model = inspect_action(source, "actions/A.py")
    assert model.diagnostics
    assert all(item.place.file == "actions/A.py" and item.place.line for item in model.diagnostics)


def test_odd_escapes_give_no_warning():
    assert inspect_action(HEAD + "    x = '\\d'\n" + BODY, "actions/A.py").diagnostics == ()
