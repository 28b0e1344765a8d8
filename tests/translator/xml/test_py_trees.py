"""XML of py_trees is read by its rules; py_trees itself runs the same file beside it."""

from __future__ import annotations

import pytest
from py_trees.parsers.behaviour_tree_xml import parse_behaviour_tree_xml

from translator import from_xml, load, to_xml
from translator.opening import open_files
from translator.xml.py_trees import is_of_py_trees
from translator.xml.source import parse_source
from tree_gardener import Tree as RunningTree

SAY = '''
import py_trees
from py_trees.ports import BehaviourWithPorts, PortInformation


class Say(BehaviourWithPorts):
    """Keeps what it was given."""

    INPUT_PORTS = {"text": PortInformation(str), "count": PortInformation(int, default_value=2)}
    OUTPUT_PORTS = {}
    SAID = []

    def update(self):
        self.SAID.append((self.get_input("text"), self.get_input("count")))
        return py_trees.common.Status.SUCCESS
'''
DOCUMENT = """<root main_tree_to_execute="Main">
  <BehaviorTree ID="Part" word="by default" number="7">
    <Sequence name="s"><Say name="p" text="{word}" count="{number}"/></Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Main" greeting="hello">
    <Selector name="sel" memory="false">
      <SuccessIsFailure name="a"><SubTree ID="Part" name="C1"/></SuccessIsFailure>
      <Inverter name="b"><SubTree ID="Part" name="C2" word="{greeting}" number="9"/></Inverter>
      <Inverter name="c"><Say name="d" text="constant"/></Inverter>
      <RunningIsFailure name="e"><SubTreePlus ID="Part" name="C3" word="last"/></RunningIsFailure>
    </Selector>
  </BehaviorTree>
</root>
"""


def types(text: str) -> list[str]:
    document = f'<root main_tree_to_execute="M"><BehaviorTree ID="M">{text}</BehaviorTree></root>'
    return [node.type for node in from_xml(document).trees["M"].walk()]


def test_the_tree_says_what_it_says_under_py_trees(tmp_path) -> None:
    path = tmp_path / "tree.xml"
    path.write_text(DOCUMENT)
    space: dict = {"__name__": "actions.Say"}
    exec(SAY, space)  # noqa: S102 - our own text
    parse_behaviour_tree_xml(str(path), node_registry={"Say": space["Say"]}).tick_once()
    said = list(space["Say"].SAID)

    project = open_files({"tree.xml": DOCUMENT.encode(), "actions/Say.py": SAY.encode()})
    exec(project.actions["RunningIsFailure"].source, space)  # noqa: S102 - our own text
    nodes = {"Say": space["Say"], "RunningIsFailure": space["RunningIsFailure"]}
    for text in (to_xml(project), to_xml(load(project.files))):
        space["Say"].SAID.clear()
        RunningTree.from_xml(text, nodes=nodes).tick_once()
        assert space["Say"].SAID == said == [("by default", 7), ("hello", 9), ("constant", 2), ("last", 7)]
    assert "BT0728" in {item.code for item in project.diagnostics}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<Selector><A/></Selector>", ["Fallback", "A"]),
        ("<selector memory='false'><A/></selector>", ["ReactiveFallback", "A"]),
        ("<Sequence memory='False'><A/></Sequence>", ["ReactiveSequence", "A"]),
        ("<Sequence memory='true'><A/></Sequence>", ["Sequence", "A"]),
        ("<Parallel policy='success_on_all'><A/></Parallel>", ["Parallel", "A"]),
        ("<Retry num_failures='3'><A/></Retry>", ["RetryUntilSuccessful", "A"]),
        ("<Repeat num_success='3'><A/></Repeat>", ["Repeat", "A"]),
        ("<FailureIsSuccess><A/></FailureIsSuccess>", ["ForceSuccess", "A"]),
        ("<successisfailure><A/></successisfailure>", ["ForceFailure", "A"]),
        ("<passthrough><A/></passthrough>", ["PassThrough", "A"]),
        ("<Condition status='RUNNING'><SuccessIsRunning><A/></SuccessIsRunning></Condition>", None),
    ],
)
def test_its_nodes_have_their_names_here(text: str, expected: list[str] | None) -> None:
    assert types(text) == (expected or ["Condition", "SuccessIsRunning", "A"])


@pytest.mark.parametrize(
    ("text", "ports"),
    [
        ("<Timeout duration='2.5'><A/></Timeout>", {"msec": "2500"}),
        ("<FailureIsSuccess><Timeout><A/></Timeout></FailureIsSuccess>", {"msec": "5000"}),
        ("<Retry num_failures='3'><A/></Retry>", {"num_attempts": "3"}),
        ("<Parallel policy='success_on_one'><A/></Parallel>", {"success_count": "1", "failure_count": "1"}),
        ("<Parallel policy='success_on_all'><A/></Parallel>", {"success_count": "-1", "failure_count": "1"}),
    ],
)
def test_their_arguments_are_ports(text: str, ports: dict[str, str]) -> None:
    document = f'<root main_tree_to_execute="M"><BehaviorTree ID="M">{text}</BehaviorTree></root>'
    nodes = from_xml(document).trees["M"].walk()
    assert ports in [dict(node.ports) for node in nodes]


@pytest.mark.parametrize("include", ["<Import src='lib.xml'/>", "<Include file='lib.xml'/>"])
def test_its_includes_are_read(include: str) -> None:
    main = f"<root>{include}<BehaviorTree ID='M'><SubTree ID='L'/></BehaviorTree></root>"
    lib = "<root><BehaviorTree ID='L'><Selector><A/></Selector></BehaviorTree></root>"
    project = from_xml(main, file="main.xml", included={"lib.xml": lib.encode()})
    assert set(project.trees) == {"M", "L"}


@pytest.mark.parametrize(
    "text",
    [
        "<root BTCPP_format='4'><BehaviorTree ID='M'><Selector/></BehaviorTree></root>",
        "<root><BehaviorTree ID='M'><Sequence><A/></Sequence></BehaviorTree></root>",
        "<root><include path='a.xml'/><BehaviorTree ID='M'><A memory='x'/></BehaviorTree></root>",
        "<root><BehaviorTree ID='M'><Timeout msec='3'><A/></Timeout></BehaviorTree></root>",
    ],
)
def test_other_documents_are_none_of_it(text: str) -> None:
    assert not is_of_py_trees(parse_source(text, file="").root)
