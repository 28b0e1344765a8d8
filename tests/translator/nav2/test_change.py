"""A project for another ROS distribution."""

from __future__ import annotations

import json

from tests.cli.typed import ROOT
from translator import check, load
from translator.archive import read_folder
from translator.importer import from_xml
from translator.nav2.change import changed
from translator.nav2.models import Lack
from translator.nav2.sources import nav2_source

JAZZY = """<root BTCPP_format="4"><BehaviorTree ID="Main"><Fallback>
<Sequence><IsPathValid path="{path}"/><SubTree ID="Short" path="{path}"/></Sequence>
<ComputePathToPose goal="{goal}" path="{path}"/></Fallback></BehaviorTree>
<BehaviorTree ID="Short">
<TruncatePathLocal input_path="{path}" output_path="{near}" robot_frame="base"/></BehaviorTree>
</root>"""


def after(files, change):
    return {path: raw for path, raw in {**files, **change.files}.items() if raw is not None}


def test_twins_are_renamed_with_their_ports_and_all_sources_are_those_of_the_distribution() -> None:
    project = from_xml(JAZZY)
    assert project.settings.ros_distro == "jazzy"
    change = changed(project.files, "lyrical")
    assert (change.lacks, change.kept) == ([], [])
    now = load(after(project.files, change))
    assert now.settings.ros_distro == "lyrical"
    assert set(now.actions) == {"ValidatePath", "TruncatePathLocal", "ComputePathToPose"}
    assert all(action.source == nav2_source(name, "lyrical") for name, action in now.actions.items())
    types = {node.type: dict(node.ports) for tree in now.trees.values() for node in tree.walk()}
    assert types["ValidatePath"] == {"path": "{path}"}
    assert types["TruncatePathLocal"]["robot_base_frame"] == "base"
    assert not [item for item in check(now) if item.is_error or item.code in {"BT0129", "BT0130"}]


def test_the_way_back_is_where_it_began() -> None:
    files = dict(from_xml(JAZZY).files)
    there = after(files, changed(files, "lyrical"))
    assert after(there, changed(there, "jazzy")) == files


def test_what_has_no_twin_is_listed_and_stays() -> None:
    tree = '<FollowPath path="{p}" error_msg="{e}"/><PersistentSequence current_child_idx="{i}"/>'
    files = from_xml(JAZZY.replace("<Fallback>", f"<Fallback>{tree}")).files
    change = changed(files, "humble")
    assert set(change.lacks) == {Lack("PersistentSequence"), Lack("FollowPath", "error_msg")}
    now = load(after(files, change))
    assert now.actions["PersistentSequence"].source == nav2_source("PersistentSequence")
    assert {item.code for item in check(now)} >= {"BT0129", "BT0130"}


def test_what_the_user_wrote_is_kept() -> None:
    files = dict(from_xml(JAZZY).files)
    files["actions/IsPathValid.py"] += b"# mine\n"
    files["project.json"] = json.dumps({**json.loads(files["project.json"]), "of_a_newer_one": [1]}).encode()
    change = changed(files, "lyrical")
    assert change.kept == ["IsPathValid"]
    assert change.lacks == [Lack("IsPathValid")]
    assert "actions/IsPathValid.py" not in change.files
    assert json.loads(change.files["project.json"] or b"")["of_a_newer_one"] == [1]


def test_a_project_without_nav2_states_its_distribution_and_nothing_more() -> None:
    files = dict(read_folder(ROOT / "examples" / "laser_bump_and_go"))
    assert changed(files, "humble").files.keys() == {"project.json"}
    assert changed(after(files, changed(files, "humble")), "humble").files == {}
