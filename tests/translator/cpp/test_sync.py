"""A project and a plugin in step: models are taken over, or their differences are said."""

from __future__ import annotations

import pytest

from tests.translator.cpp.hostile import SOURCES, hostile_project
from tests.translator.cpp.test_package import WRITTEN
from translator import InStep, Project, TranslatorError, load, take_over, to_cpp_package
from translator.stub import stub_source
from translator.xml.read import read_document


def models(project: Project) -> str:
    package = to_cpp_package(project)
    return package.files[f"{package.name}/models/{package.name}.xml"].decode()


def codes(result: InStep) -> list[str]:
    return [item.code for item in result.diagnostics]


def test_what_was_exported_changes_nothing(example) -> None:
    assert take_over(example, models(example)) == InStep()


def test_what_behaviortree_cpp_writes_of_it_changes_nothing() -> None:
    assert take_over(hostile_project(), WRITTEN) == InStep()


@pytest.mark.parametrize(
    ("old", "new", "port", "ours", "theirs"),
    [
        (
            'name="count" type="int"',
            'name="count" type="double"',
            "count",
            "input_port int",
            "input_port double",
        ),
        ('default="3"', 'default="4"', "int", 'input_port int "3"', 'input_port int "4"'),
        ('type="Color"', 'type="robot::Gear"', "color", 'Color "A__B"', 'Gear "A__B"'),
        ("An object.", "A pose.", "pose", "(An object.)", "(A pose.)"),
        ('name="reals"', 'name="numbers"', "numbers", "–", "input_port std::vector<double>"),
        ('name="reals"', 'name="numbers"', "reals", "input_port std::vector<double>", "–"),
    ],
)
def test_a_difference_to_written_code_is_said(old: str, new: str, port: str, ours: str, theirs: str) -> None:
    project = hostile_project()
    text = models(project)
    assert old in text
    result = take_over(project, text.replace(old, new), file="plugin.xml")
    assert result.files == {}
    [found] = [item for item in result.diagnostics if item.place.port == port]
    assert found.code == "BT0744"
    assert (found.place.file, found.place.line) == ("actions/switch.py", project.actions["switch"].line)
    assert dict(found.values)["ours"].endswith(ours)
    assert dict(found.values)["theirs"].endswith(theirs)
    assert "plugin.xml" in found.message


def test_another_kind_is_said() -> None:
    project = hostile_project()
    result = take_over(project, models(project).replace('Condition ID="Робот"', 'Action ID="Робот"'))
    assert codes(result) == ["BT0745"]


def with_stub(text: str) -> Project:
    """Returns the hostile project with `switch` as a stub of its model in these models."""
    project = hostile_project()
    model = read_document(text.encode(), file="m").models["switch"]
    source = stub_source("switch", model, ()).encode()
    return load({**project.files, "actions/switch.py": source})


def test_an_unwritten_action_gets_the_ports_of_its_model() -> None:
    text = models(hostile_project())
    project = with_stub(text)
    changed = text.replace('name="count" type="int"', 'name="count" type="double"')
    result = take_over(project, changed)
    assert list(result.files) == ["actions/switch.py"]
    assert codes(result) == ["BT0743"]
    after = load({**project.files, **result.files})
    [port] = [port for port in after.actions["switch"].ports if port.name == "count"]
    assert port.type == "double"
    assert {port.name: port.type for port in after.actions["switch"].ports}["color"].startswith("Color[")
    # And then they are in step.
    assert take_over(after, changed) == InStep()


def test_a_new_node_becomes_a_stub() -> None:
    project = hostile_project()
    text = models(project).replace(
        "<TreeNodesModel>",
        '<TreeNodesModel><Decorator ID="Gate"><input_port name="n"/></Decorator><Action ID="a-b"/>',
    )
    result = take_over(project, text)
    assert list(result.files) == ["actions/Gate.py"]
    assert b"class Gate(DecoratorNode)" in result.files["actions/Gate.py"]
    assert codes(result) == ["BT0743", "BT0747"]


def test_a_node_that_is_gone_is_said() -> None:
    project = hostile_project()
    result = take_over(
        project, '<root BTCPP_format="4"><TreeNodesModel><Action ID="tick"/></TreeNodesModel></root>'
    )
    assert codes(result) == ["BT0748"] * (len(SOURCES) - 1)
    assert not any(item.is_error for item in result.diagnostics)


def test_an_action_without_declarations_takes_any_port(make_project) -> None:
    project = make_project({"n1": {"type": "Open", "ports": {"far": "1"}}})
    assert take_over(project, models(project)) == InStep()
    told = take_over(project, models(project).replace('type="BT::AnyTypeAllowed"', 'type="int"'))
    assert codes(told) == []


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("<root", "BT0701"),
        ('<root BTCPP_format="4"/>', "BT0746"),
        (
            '<root BTCPP_format="4"><TreeNodesModel><Control ID="Sequence"/></TreeNodesModel></root>',
            "BT0746",
        ),
    ],
)
def test_what_has_no_models_is_refused(text: str, code: str) -> None:
    with pytest.raises(TranslatorError, match=code):
        take_over(hostile_project(), text)
