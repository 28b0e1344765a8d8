"""ROS nodes of a tree: their ports, endpoints and packages."""

from __future__ import annotations

from translator import from_xml, to_ros2_package, to_xml
from translator.catalog import builtins
from translator.ros_nodes import direction_of, interface_of, ros_endpoints, ros_packages, with_fields

PORTS = {
    "action_name": "/navigate_to_pose",
    "action_type": "nav2_msgs/NavigateToPose",
    "goal__pose__pose__position__x": "1.5",
    "result__error_code": "{code}",
}
GOAL = {"type": "RosAction", "ports": PORTS}


def trees_of(make_project, node):
    return make_project({"n1": node}).trees.values()


def node_of(make_project, node):
    return next(node for tree in trees_of(make_project, node) for node in tree.walk())


def test_the_fields_of_the_type_are_ports(make_project):
    node = node_of(make_project, GOAL)
    assert interface_of(node) == "nav2_msgs/action/NavigateToPose"
    model = with_fields(builtins()["RosAction"], node)
    assert model.ports["goal__pose__pose__position__x"].type == "double"
    assert model.ports["goal"].direction == "input"
    assert not model.open


def test_a_type_that_is_not_here_or_comes_from_an_entry_leaves_the_node_open(make_project):
    for type_ in ("other_msgs/action/Go", "{type}"):
        node = node_of(make_project, {**GOAL, "ports": {**PORTS, "action_type": type_}})
        assert with_fields(builtins()["RosAction"], node).open


def test_directions():
    assert direction_of("RosSubscribe", "message__x") == "output"
    assert direction_of("RosPublish", "message__x") == "input"
    assert direction_of("RosAction", "action_name") is None
    assert direction_of("Sequence", "goal__x") is None


def test_endpoints_and_packages(make_project):
    (found,) = ros_endpoints(trees_of(make_project, GOAL))
    assert (found.name, found.kind, found.type) == (
        "/navigate_to_pose",
        "action client",
        "nav2_msgs/action/NavigateToPose",
    )
    assert ros_packages(trees_of(make_project, GOAL)) == {"nav2_msgs", "action_msgs"}
    assert ros_packages(trees_of(make_project, {"type": "TfLookup"})) == {"geometry_msgs", "tf2_msgs"}


def test_a_package_depends_on_the_interfaces_and_names_the_endpoint(make_project):
    package = to_ros2_package(make_project({"n1": GOAL}))
    manifest = package.files["test_bt/package.xml"].decode()
    assert "<exec_depend>nav2_msgs</exec_depend>" in manifest
    readme = package.files["test_bt/README.md"].decode()
    assert "| `/navigate_to_pose` | `nav2_msgs/action/NavigateToPose` | calls the action |" in readme
    assert "tree_gardener/tree_gardener/ros_nodes/action.py" in package.files


def test_the_xml_models_the_node_for_other_programs_and_reads_back(make_project):
    text = to_xml(make_project({"n1": GOAL}))
    assert '<Action ID="RosAction">' in text
    assert '<output_port name="result__error_code"/>' in text
    assert '<input_port name="goal__pose__pose__position__x"/>' in text
    again = from_xml(text)
    node = next(node for tree in again.trees.values() for node in tree.walk())
    assert node.type == "RosAction"
    assert dict(node.ports) == GOAL["ports"]
