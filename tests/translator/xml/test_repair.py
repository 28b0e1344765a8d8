"""Imports that need a repair: bare characters, palettes, empty names."""

from __future__ import annotations

import io
import zipfile

import pytest

from translator import TranslatorError, check, from_xml, open_files, open_path, to_xml
from translator.xml.repair import repaired, repairs_of

TREE = """<root BTCPP_format="4">
<!-- a & b < c "quoted" -->
<BehaviorTree ID="Main">
  <Sequence name='"A" & B'>
    <Script code=" x := 1 &amp; 3 & 2 "/><ScriptCondition code="a < b && c"/>
  </Sequence>
</BehaviorTree>
<![CDATA[ & < ]]></root>"""
REPAIRED = (
    TREE.replace("A\" & B'", "A\" &amp; B'")
    .replace("3 & 2", "3 &amp; 2")
    .replace("a < b && c", "a &lt; b &amp;&amp; c")
)


def test_only_bare_characters_in_attributes_are_repaired():
    repairs = repairs_of(TREE)
    assert repaired(TREE, repairs) == REPAIRED.replace("&amp;amp;", "&amp;")
    assert [repair.before for repair in repairs] == ["&", "&", "<", "&", "&"]
    assert repairs_of(REPAIRED) == []


def test_a_repair_is_offered_place_by_place_and_made_when_asked(tmp_path):
    document = TREE.replace("<![CDATA[ & < ]]>", "")
    path = tmp_path / "bare.xml"
    path.write_text(document)
    with pytest.raises(TranslatorError) as refused:
        open_path(path)
    found = refused.value.diagnostics
    assert [(item.code, item.place.line) for item in found] == [("BT0740", line) for line in (4, 5, 5, 5, 5)]
    assert "“&” stands alone" in found[0].message
    assert "--repair" in found[0].hint
    project = open_path(path, repair=True)
    (condition,) = [node for node in project.trees["Main"].walk() if node.type == "ScriptCondition"]
    assert condition.ports["code"] == "a < b && c"
    assert b"a &lt; b &amp;&amp; c" in project.files["imports/bare.xml"]
    assert path.read_text() == document


@pytest.mark.parametrize(
    "text",
    [
        '<root><BehaviorTree name="a & b"></root>',
        '<root name="a & b',
        "<root>a & b</root>",
        '<root a="&">&</root>',
    ],
)
def test_what_a_repair_does_not_make_readable_is_not_offered(text):
    with pytest.raises(TranslatorError) as refused:
        from_xml(text)
    assert [item.code for item in refused.value.diagnostics] == ["BT0701"]


def test_entities_that_xml_does_not_have_are_kept_as_text():
    text = (
        '<root BTCPP_format="4"><BehaviorTree ID="M"><Script code="x := \'&nbsp;\'"/></BehaviorTree></root>'
    )
    project = open_files({"a.xml": text.encode()}, repair=True)
    assert next(project.trees["M"].walk()).ports["code"] == "x := '&nbsp;'"


def test_the_repair_reaches_what_is_included():
    main = b'<root BTCPP_format="4" main_tree_to_execute="M"><include path="b.xml"/></root>'
    other = b'<root BTCPP_format="4"><BehaviorTree ID="M"><Script code="x := 1 & 1"/></BehaviorTree></root>'
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("a.btproj", main)
        archive.writestr("b.xml", other)
    files = {"a.btproj": main, "b.xml": other}
    with pytest.raises(TranslatorError, match="BT0740"):
        open_files(files)
    assert "M" in open_files(files, repair=True).trees


PALETTE = """<root BTCPP_format="4"><TreeNodesModel>
  <Action ID="Spin"><input_port name="angle" type="double" default="1.57">How far.</input_port></Action>
  <Condition ID="IsStuck"/>
  <Decorator ID="RateController"><input_port name="hz" type="double"/></Decorator>
  <Control ID="PipelineSequence"/>
  <Action ID="AlwaysSuccess"/>
</TreeNodesModel></root>"""


def test_a_palette_opens_as_actions_without_a_tree():
    project = from_xml(PALETTE)
    kinds = {name: action.kind for name, action in sorted(project.actions.items())}
    assert kinds == {
        "IsStuck": "condition",
        "PipelineSequence": "control",
        "RateController": "decorator",
        "Spin": "action",
    }
    (hz,) = project.actions["RateController"].ports
    assert (hz.name, hz.type) == ("hz", "double")
    assert [(port.name, port.default) for port in project.actions["Spin"].ports] == [("angle", "1.57")]
    assert [tree.root for tree in project.trees.values()] == [None]
    assert "BT0741" in [item.code for item in project.diagnostics]
    with pytest.raises(TranslatorError, match="BT0734"):
        from_xml('<root BTCPP_format="4"/>')


EMPTY = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence name=""><AlwaysSuccess name="a"/><SubTree ID="B"/></Sequence></BehaviorTree>
<BehaviorTree ID="B"><AlwaysSuccess name=""/></BehaviorTree></root>"""


def test_a_name_that_is_there_and_empty_is_kept():
    project = from_xml(EMPTY)
    written = to_xml(project)
    assert written.count('name=""') == 2
    again = open_files({path: raw for path, raw in project.files.items() if not path.startswith("imports/")})
    assert to_xml(again).count('name=""') == 2
    assert [item.code for item in check(project) if item.is_error] == []
    wrong = from_xml(EMPTY.replace('<SubTree ID="B"/>', '<SubTree ID="B" name=""/>'))
    assert "BT0507" in [item.code for item in check(wrong)]


OWN = """<root BTCPP_format="4"><BehaviorTree ID="M"><{name}><Sequence><AlwaysSuccess/>
    <ControllerSelector/><GoalUpdate/></Sequence></{name}></BehaviorTree></root>"""


@pytest.mark.parametrize(
    ("name", "near"), [("inverter", "Inverter"), ("Sequenze", "Sequence"), ("Repaet", "Repeat")]
)
def test_a_built_in_name_that_is_spelled_wrong_is_suggested_and_gets_no_stub(name, near):
    project = from_xml(OWN.format(name=name))
    assert name not in project.actions
    (finding,) = [item for item in check(project) if item.code == "BT0112"]
    assert f"Did you mean {near}?" in finding.hint


@pytest.mark.parametrize("name", ["KeepTrying", "RateController", "GoalUpdater"])
def test_another_name_gets_a_stub_or_is_said_to_be_written(name):
    project = from_xml(OWN.format(name=name))
    assert project.actions[name].kind == "decorator"
    assert [item.code for item in check(project) if item.is_error] == []
    (finding,) = [
        item for item in check(from_xml(OWN.format(name=name), stubs=False)) if item.code == "BT0112"
    ]
    assert (
        f"Write actions/{name}.py with a class {name} derived from tree_gardener.DecoratorNode"
        in finding.hint
    )
