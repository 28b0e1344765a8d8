"""Checks of nodes of Nav2 against the ROS distribution of a project."""

from __future__ import annotations

import json

from translator import check, load
from translator.check.context import Context
from translator.check.nav2 import check_nav2
from translator.importer import from_xml
from translator.nav2.models import distribution_for

TREE = """<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>
<GoalUpdated/>{more}</Sequence></BehaviorTree></root>"""


def project(more: str, distribution: str | None):
    made = from_xml(TREE.replace("{more}", more))
    settings = json.loads(made.files["project.json"])
    settings.pop("ros_distro")
    if distribution is not None:
        settings["ros_distro"] = distribution
    return load({**made.files, "project.json": json.dumps(settings).encode()})


def found(made):
    context = Context(made, [])
    check_nav2(context)
    return {item.code: dict(item.values) for item in context.found}


def test_a_node_of_another_distribution_is_named_with_its_twin() -> None:
    made = project('<ValidatePath path="{path}"/>', "jazzy")
    told = {"type": "ValidatePath", "distribution": "Jazzy", "those": "Lyrical", "twin": "IsPathValid"}
    assert found(made) == {"BT0129": told}
    place = next(item.place for item in check(made) if item.code == "BT0129")
    assert (place.tree, place.node is not None) == ("Main", True)
    assert found(project('<ValidatePath path="{path}"/>', "lyrical")) == {}


def test_a_port_of_another_distribution_is_named_with_its_twin() -> None:
    more = '<TruncatePathLocal input_path="{p}" output_path="{q}" robot_base_frame="base"/>'
    told = found(project(more, "kilted"))["BT0130"]
    assert told == {
        "port": "robot_base_frame",
        "type": "TruncatePathLocal",
        "distribution": "Kilted",
        "those": "Lyrical",
        "twin": "robot_frame",
    }
    assert found(project('<FollowPath path="{p}" error_msg="{e}"/>', "jazzy"))["BT0130"]["twin"] == "none"


def test_without_a_statement_it_is_jazzy_or_the_newest_that_has_all() -> None:
    assert distribution_for(project('<ClearEntireCostmap service_name="c"/>', None)) == "jazzy"
    assert distribution_for(project('<FollowPath path="{p}" error_msg="{e}"/>', None)) == "lyrical"
    assert distribution_for(project("<IsStopped/>", None)) == "kilted"
    assert found(project('<FollowPath path="{p}" error_msg="{e}"/>', None)) == {}


def test_a_tree_that_mixes_two_names_the_node() -> None:
    mixed = project('<IsStopped/><ValidatePath path="{p}"/>', None)
    assert found(mixed)["BT0129"]["type"] == "IsStopped"


def test_a_node_of_the_user_with_such_a_name_is_his() -> None:
    made = project('<ValidatePath path="{path}"/>', "jazzy")
    own = {**made.files, "actions/ValidatePath.py": b'"""Mine."""\n' + made.files["actions/ValidatePath.py"]}
    assert found(load(own)) == {}
