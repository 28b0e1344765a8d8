"""XML in: v3 and v4, compact and explicit, models, includes, Groot2 projects, Nav2's trees, stubs."""

from __future__ import annotations

import pytest

from translator import check, export_files, from_xml, load, to_xml
from translator.xml.read import read_document

EXPLICIT = """<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Control ID="Sequence" name="s">
      <Condition ID="Battery" level="{l}"/>
      <Decorator ID="Inverter"><Action ID="Go" _uid="7"/></Decorator>
      <SubTree ID="Sub" x="{=}" _autoremap="true"/>
    </Control>
  </BehaviorTree>
  <BehaviorTree ID="Sub"><AlwaysSuccess _skipIf="x &gt; 1"/></BehaviorTree>
  <TreeNodesModel>
    <Condition ID="Battery"><input_port name="level" type="double" default="0.2">Full</input_port></Condition>
    <Action ID="Go">
      <output_port name="at" type="std::string"/><inout_port name="n" type="std::vector&lt;int&gt;"/>
    </Action>
    <SubTree ID="Sub"><input_port name="x" default="3"/></SubTree>
  </TreeNodesModel>
</root>
"""
V3 = """<root main_tree_to_execute="M">
  <!-- of old -->
  <BehaviorTree ID="M"><SequenceStar>
    <RetryUntilSuccesful num_attempts="3"><Foo/></RetryUntilSuccesful>
    <Parallel success_threshold="1" failure_threshold="2"><Foo/><Foo/></Parallel>
    <BlackboardCheckString value_A="{x}" value_B="abc" return_on_mismatch="SUCCESS"><Foo/>
    </BlackboardCheckString>
    <BlackboardCheckInt value_A="{x}" value_B="5"><Foo/></BlackboardCheckInt>
    <SubTree ID="S" k="outer" __shared_blackboard="true"/>
    <SubTreePlus ID="S" k="lit" j="{z}" __autoremap="1"/>
  </SequenceStar></BehaviorTree>
  <BehaviorTree ID="S"><Foo/></BehaviorTree>
</root>"""
NAV2 = """<root BTCPP_format="4" main_tree_to_execute="MainTree">
  <BehaviorTree ID="MainTree">
    <RecoveryNode number_of_retries="6" name="NavigateRecovery">
      <PipelineSequence name="NavigateWithReplanning">
        <RateController hz="1.0">
          <ComputePathToPose goal="{goal}" path="{path}" planner_id="GridBased"/>
        </RateController>
        <FollowPath path="{path}" controller_id="FollowPath"/>
      </PipelineSequence>
      <ReactiveFallback name="RecoveryFallback"><GoalUpdated/><Wait wait_duration="5.0"/></ReactiveFallback>
    </RecoveryNode>
  </BehaviorTree>
</root>
"""


def test_explicit_form_models_and_metadata():
    project = from_xml(EXPLICIT, file="a.xml")
    assert [node.type for node in project.trees["Main"].walk()] == [
        "Sequence",
        "Battery",
        "Inverter",
        "Go",
        "SubTree",
    ]
    assert project.trees["Main"].nodes["n4"].attributes == {"_uid": "7"}
    assert project.trees["Main"].nodes["n5"].autoremap
    assert [(port.name, port.default) for port in project.trees["Sub"].ports] == [("x", "3")]
    assert project.actions["Battery"].kind == "condition"
    ports = {port.name: (port.direction, port.type) for port in project.actions["Go"].ports}
    assert ports == {"at": ("output", "string"), "n": ("inout", "list[int]")}
    assert to_xml(project) == EXPLICIT


def test_v3_is_exported_as_v4_with_each_change_told():
    project = from_xml(V3, file="old.xml")
    text = to_xml(project)
    assert '<root main_tree_to_execute="M" BTCPP_format="4">' in text
    assert "<!-- of old -->" in text
    for line in (
        "<SequenceWithMemory>",
        '<RetryUntilSuccessful num_attempts="3">',
        '<Parallel success_count="1" failure_count="2">',
        '<Precondition if="x == \'abc\'" else="SUCCESS">',
        '<Precondition if="x == 5" else="FAILURE">',
        '<SubTree ID="S" k="{outer}" _autoremap="true"/>',
        '<SubTree ID="S" k="lit" j="{z}" _autoremap="true"/>',
    ):
        assert line in text
    changes = [item for item in project.diagnostics if item.code == "BT0720"]
    assert len(changes) == 10
    assert 'k="outer" is now k="{outer}".' in [item.message for item in changes]
    assert all(item.place.line and item.place.file == "imports/old.xml" for item in changes)
    assert from_xml(text).trees["M"].nodes.keys() == project.trees["M"].nodes.keys()
    assert to_xml(from_xml(text)) == text


def test_nav2_trees_are_kept_and_get_stubs_of_the_right_kind():
    project = from_xml(NAV2, file="nav2.xml")
    assert to_xml(project) == NAV2
    assert [item for item in check(project) if item.is_error] == []
    kinds = {name: action.kind for name, action in project.actions.items()}
    leaves = {name for name, kind in kinds.items() if kind == "action"}
    assert leaves == {"ComputePathToPose", "FollowPath", "Wait"}
    assert {name: kind for name, kind in kinds.items() if name not in leaves} == {
        "RecoveryNode": "control",
        "PipelineSequence": "control",
        "RateController": "decorator",
        "GoalUpdated": "condition",
    }
    without = from_xml(NAV2, file="nav2.xml", stubs=False)
    assert {item.place.node for item in check(without) if item.code == "BT0112"} == {"n1", "n2", "n3"}
    edited = project.with_tree(project.main.edited("n5", ports={"path": "{path}", "controller_id": "Other"}))
    assert to_xml(edited) == NAV2.replace('controller_id="FollowPath"', 'controller_id="Other"')


INCLUDING = (
    b'<root BTCPP_format="4" project_name="Patrol robot">'
    b'<include path="trees/a.xml"/><include path="./trees/b.xml"/></root>'
)
A = (
    b'<root BTCPP_format="4" main_tree_to_execute="A"><include path="b.xml"/>'
    b'<BehaviorTree ID="A"><SubTree ID="B"/></BehaviorTree></root>'
)
B = (
    b'<root BTCPP_format="4"><include path="a.xml"/>'
    b'<BehaviorTree ID="B"><AlwaysSuccess/></BehaviorTree></root>'
)


def test_groot2_project_with_includes_each_read_once():
    project = from_xml(INCLUDING, file="robot.btproj", included={"trees/a.xml": A, "trees/b.xml": B})
    assert project.settings.name == "Patrol robot"
    assert project.settings.main_tree == "A"
    assert set(project.trees) == {"A", "B"}
    assert not [item for item in check(project) if item.is_error]
    assert export_files(project) == {"robot.btproj": INCLUDING, "trees/a.xml": A, "trees/b.xml": B}
    assert 'ID="B"' in to_xml(load(project.files))
    edited = project.with_tree(project.trees["B"].edited("n1", type="AlwaysFailure"))
    assert export_files(edited)["trees/b.xml"] == B.replace(b"AlwaysSuccess", b"AlwaysFailure")
    assert export_files(edited)["trees/a.xml"] == A


@pytest.mark.parametrize(
    ("include", "code"),
    [
        ("<include/>", "BT0730"),
        ('<include ros_pkg="p" path="x.xml"/>', "BT0731"),
        ('<include path="../../etc/passwd"/>', "BT0732"),
        ('<include path="/etc/passwd"/>', "BT0732"),
        ('<include path="nothing.xml"/>', "BT0733"),
    ],
)
def test_unreadable_includes_are_reported(include, code):
    text = f'<root BTCPP_format="4">{include}<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>'
    (found,) = from_xml(text, file="dir/a.xml").diagnostics
    assert (found.code, found.place.file, found.place.line) == (code, "imports/dir/a.xml", 1)


TREE = '<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>'


@pytest.mark.parametrize(
    ("inside", "code"),
    [
        (TREE + "<TreeNodesModel/><TreeNodesModel/>", "BT0710"),
        (TREE + "<Strange/>", "BT0711"),
        (TREE + "<BehaviorTree><AlwaysSuccess/></BehaviorTree>", "BT0712"),
        (TREE + TREE, "BT0713"),
        ('<BehaviorTree ID="T"><AlwaysSuccess/><AlwaysSuccess/></BehaviorTree>', "BT0714"),
        ('<BehaviorTree ID="T"/>', "BT0722"),
        ('<BehaviorTree ID="T"><AlwaysSuccess ID="x"/></BehaviorTree>', "BT0715"),
        ('<BehaviorTree ID="T"><Action/></BehaviorTree>', "BT0716"),
        (TREE + "<TreeNodesModel><Action/></TreeNodesModel>", "BT0717"),
        (TREE + '<BehaviorTree ID="U"><AlwaysSuccess/></BehaviorTree>', "BT0735"),
    ],
)
def test_oddities_are_reported_and_the_file_kept(inside, code):
    text = f'<root BTCPP_format="4">{inside}</root>'
    project = from_xml(text)
    assert code in [item.code for item in project.diagnostics]
    assert to_xml(project) == text


def test_disabled_node_keeps_its_own_condition(make_project):
    node = {
        "type": "AlwaysSuccess",
        "disabled": True,
        "conditions": {"_skipIf": "1 == 2", "_failureIf": "true"},
    }
    text = to_xml(make_project({"n1": node}))
    assert '_bts_skipIf="1 == 2" _bts_failureIf="true" _skipIf="true" _bts_disabled="1"' in text
    (source,) = read_document(text, file="x").trees
    assert source.tree.nodes["n1"].disabled
    assert source.tree.nodes["n1"].conditions == {"_skipIf": "1 == 2", "_failureIf": "true"}


def test_action_that_xml_cannot_name_is_written_explicitly(make_project):
    name = "Ꭰo"  # a Python identifier, but no XML name for expat
    source = f"import py_trees\nclass {name}(py_trees.behaviour.Behaviour):\n    def update(self): pass\n"
    project = make_project({"n1": {"type": name}}, actions={name: source})
    assert f'<Action ID="{name}"' in to_xml(project)
    (read,) = read_document(to_xml(project), file="x").trees
    assert read.tree.nodes["n1"].type == name
