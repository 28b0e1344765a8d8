"""The classes of a project's nodes: names, bases, ports."""

from __future__ import annotations

from tests.translator.cpp.hostile import hostile_project
from translator.cpp.nodes import CppNode, can_be_port, cpp_enums, cpp_nodes, ros_blocks


def nodes() -> dict[str, CppNode]:
    project = hostile_project()
    taken: set[str] = set()
    enums = cpp_enums(project, taken)
    return {node.id: node for node in cpp_nodes(project, taken, enums)}


def test_names_are_valid_and_differ() -> None:
    names = {node.id: (node.class_name, node.file) for node in nodes().values()}
    assert names["Cafe"] == ("Cafe", "cafe")
    assert names["Café"] == ("Cafe_2", "cafe_2")
    assert names["FooBar"] == ("FooBar", "foo_bar")
    assert names["Foo_Bar"] == ("Foo_Bar", "foo_bar_2")
    assert names["tick"] == ("tick_", "tick_")
    # The enumeration "switch" has the name already.
    assert names["switch"] == ("switch_2", "switch_2")


def test_the_base_is_that_of_the_kind() -> None:
    bases = {node.id: node.base for node in nodes().values()}
    assert bases["switch"] == "SyncActionNode"
    assert bases["Café"] == "StatefulActionNode"
    assert bases["Робот"] == "ConditionNode"
    assert bases["Both"] == "ControlNode"
    assert bases["Once"] == "DecoratorNode"
    assert nodes()["Both"].children == "2 or more"


def test_a_base_from_elsewhere_may_run_on(make_project) -> None:
    source = "from robot import Base\n\n\nclass Act(Base):\n    INPUT_PORTS = {}\n"
    [act] = [node for node in cpp_nodes(make_project({}, actions={"Act": source}), set()) if node.id == "Act"]
    assert act.base == "StatefulActionNode"


def test_ports_have_types_of_cpp() -> None:
    ports = {port.model.name: port for port in nodes()["switch"].ports}
    types = {name: port.type for name, port in ports.items()}
    assert types["int"] == "int"
    assert types["speed"] == "double"
    assert types["color"] == "Color"
    assert types["pose"] == "std::string"
    assert "convertFromString" in ports["pose"].note
    assert types["anything"] == "BT::AnyTypeAllowed"
    assert types["words"] == "std::vector<std::string>"
    assert types["truths"] == "std::vector<bool>"
    assert (ports["int"].variable, ports["this"].variable) == ("int_", "this_")
    assert {ports["a-b"].variable, ports["a_b"].variable} == {"a_b", "a_b_2"}
    assert ports["both"].function == "BidirectionalPort"


def test_a_default_of_a_bool_is_no_address() -> None:
    ports = {port.model.name: port for port in nodes()["switch"].ports}
    assert ports["flag"].default == 'std::string("false")'
    assert ports["both"].default == 'std::string("{both}")'
    assert ports["int"].default == '"3"'
    assert ports["count"].default is None
    # An output has no default but an entry.
    assert ports["loose"].default is None
    assert ports["result"].default == '"{=}"'


def test_ports_that_cpp_does_not_take_are_left_out_and_said() -> None:
    node = nodes()["switch"]
    assert node.left_out == ("a.b",)
    (found,) = node.diagnostics()
    assert found.code == "BT0930"
    assert found.place.file == "actions/switch.py"
    assert not can_be_port("_onSuccess")
    assert can_be_port("aключ")


def test_ports_of_an_undeclared_action_are_those_of_the_trees(make_project) -> None:
    project = make_project({"n1": {"type": "Open", "ports": {"far": "1"}}})
    [node] = [node for node in cpp_nodes(project, set()) if node.id == "Open"]
    assert [(port.model.name, port.type) for port in node.ports] == [("far", "BT::AnyTypeAllowed")]


def test_blocks_of_ros_are_listed(make_project) -> None:
    ports = {"service_name": "/enable", "service_type": "std_srvs/srv/SetBool"}
    project = make_project({"n1": {"type": "RosService", "name": "Enable", "ports": ports}})
    assert ros_blocks(project) == [("RosService", "Enable", "MainTree", "std_srvs/srv/SetBool")]
