"""The self-contained form of 2024, read and written."""

from __future__ import annotations

import pytest

from translator import TranslatorError, check
from translator.jderobot.self_contained import is_old_form, read_old_form, write_old_form

OLD = """<?xml version="1.0" ?>
<Root name="Tree Root">
  <BehaviorTree>
    <Sequence name="Sequence">
      <Forward name="Forward" speed="{v}"/>
    </Sequence>
  </BehaviorTree>
  <Code>
    <Forward>
      import py_trees
      class Forward(py_trees.behaviour.Behaviour):
          def update(self):
              return 1 &lt; 2
    </Forward>
  </Code>
</Root>
"""


def test_old_form_is_read():
    assert is_old_form(OLD)
    project = read_old_form(OLD)
    assert project.files["actions/Forward.py"].startswith(b"import py_trees\nclass Forward")
    assert b"return 1 < 2" in project.files["actions/Forward.py"]
    assert [node.type for node in project.main.walk()] == ["Sequence", "Forward"]
    assert project.settings.on_finish == "repeat"
    assert check(project) == ()


def test_written_form_reads_back(example):
    again = read_old_form(write_old_form(example))
    assert [node.type for node in again.main.walk()] == [node.type for node in example.main.walk()]
    for name in example.actions:
        assert again.actions[name].source.strip() == example.actions[name].source.strip()


def test_subtrees_are_written_in_place(make_project):
    call = {"type": "SubTree", "tree": "Inner", "attributes": {"_autoremap": "true"}}
    project = make_project({"n1": call}, trees={"Inner": {"n1": {"type": "AlwaysSuccess"}}})
    assert "SubTree" not in write_old_form(project)
    assert "<AlwaysSuccess" in write_old_form(project)


@pytest.mark.parametrize(
    "node",
    [
        {"type": "AlwaysSuccess", "conditions": {"_skipIf": "true"}},
        {"type": "AlwaysSuccess", "disabled": True},
    ],
)
def test_what_that_system_has_not_is_refused(make_project, node):
    with pytest.raises(TranslatorError) as error:
        write_old_form(make_project({"n1": node}))
    assert error.value.diagnostics[0].code == "BT0810"


@pytest.mark.parametrize("text", ["<Root/>", "<Root name='x'></Root>", "<Other/>", "<Root>"])
def test_what_has_no_tree_is_refused(text):
    with pytest.raises(TranslatorError) as error:
        read_old_form(text)
    assert error.value.diagnostics[0].place.file


def test_empty_tree_is_kept():
    assert read_old_form("<Root><BehaviorTree/></Root>").main.root is None
