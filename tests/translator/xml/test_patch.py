"""Changes of imported files: only what changed is rewritten, in the file's own style."""

from __future__ import annotations

from dataclasses import replace

import pytest

from translator import Node, Tree, from_xml, to_xml
from translator.export import source_documents
from translator.xml.patch import patch_document

TEXT = """<?xml version="1.0"?>
<!-- head -->
<root   BTCPP_format='4'
   main_tree_to_execute="Main">
  <!-- a tree -->
  <BehaviorTree ID="Main">
      <Sequence name="s"   _x="1">
          <!-- first -->
          <Action ID="Foo" b='x"y' a="{k}"/>
          <AlwaysSuccess   />   <!-- tail -->
      </Sequence>
  </BehaviorTree>

  <BehaviorTree ID="Sub"><Inverter><Foo a="3"></Foo></Inverter></BehaviorTree>
</root>
<!-- end -->
"""


@pytest.fixture(params=["\n", "\r\n"])
def imported(request):
    return from_xml(TEXT.replace("\n", request.param), file="a.xml"), request.param


def written(project, newline):
    return to_xml(project).replace(newline, "\n")


def test_values_keep_order_and_quotes(imported):
    project, newline = imported
    tree = project.main.edited("n2", ports={"a": "it's <5>", "b": "z", "c": "new"})
    expected = TEXT.replace("""b='x"y' a="{k}"/>""", """b='z' a="it's &lt;5&gt;" c="new"/>""")
    assert written(project.with_tree(tree), newline) == expected


def test_value_that_is_gone(imported):
    project, newline = imported
    tree = project.main.edited("n2", ports={"a": "{k}"})
    assert written(project.with_tree(tree), newline) == TEXT.replace(""" b='x"y'""", "")


@pytest.mark.parametrize("type_", ["Action", "Control", "3D scan"])
def test_new_type_that_cannot_be_a_tag(imported, type_):
    project, newline = imported
    tree = project.main.edited("n3", type=type_)
    expected = TEXT.replace("<AlwaysSuccess   />", f'<Action ID="{type_}"   />')
    assert written(project.with_tree(tree), newline) == expected


def test_new_type_keeps_the_form_of_the_tag(imported):
    project, newline = imported
    tree = project.main.edited("n2", type="Bar").edited("n1", type="Fallback")
    expected = TEXT.replace('ID="Foo" b', 'ID="Bar" b').replace("<Sequence", "<Fallback")
    assert written(project.with_tree(tree), newline) == expected.replace("</Sequence", "</Fallback")


def test_removed_and_reordered_children(imported):
    project, newline = imported
    without = '\n          <!-- first -->\n          <Action ID="Foo" b=\'x"y\' a="{k}"/>'
    assert written(project.with_tree(project.main.removed("n2")), newline) == TEXT.replace(without, "")
    swapped = project.main.edited("n1", children=("n3", "n2"))
    text = written(project.with_tree(swapped), newline)
    assert text.index("AlwaysSuccess") < text.index("<!-- first -->") < text.index('"Foo"')
    assert "<!-- tail -->" in text


def test_added_nodes_take_the_indentation(imported):
    project, newline = imported
    tree = project.main.inserted(Node("x", "Inverter"), parent="n1").inserted(Node("y", "Foo"), parent="x")
    text = written(project.with_tree(tree), newline)
    assert '<Inverter _bts_id="x">' in text
    assert '<Foo _bts_id="y"/>' in text
    assert newline == "\n" or "\n" not in to_xml(project.with_tree(tree)).replace("\r\n", "")


def test_child_of_a_tag_that_had_none(imported):
    project, _ = imported
    tree = project.main.inserted(Node("x", "Foo"), parent="n3")
    (again,) = [
        item for item in from_xml(to_xml(project.with_tree(tree))).trees.values() if item.id == "Main"
    ]
    assert again.nodes["n3"].children == ("x",)


def test_added_and_removed_trees_and_another_main(imported):
    project, newline = imported
    more = project.with_tree(Tree("New", "n1", {"n1": Node("n1", "AlwaysSuccess")}))
    text = written(more, newline)
    assert text.startswith(TEXT[: TEXT.index("</root>")].rstrip("\n"))
    assert '<BehaviorTree ID="New">' in text
    trees = {"Main": project.trees["Main"]}
    sub = TEXT[TEXT.index("\n\n  <BehaviorTree") : TEXT.index("\n</root>")]
    gone = written(replace(project, trees=trees), newline)
    assert gone.replace("\n\n", "\n") == TEXT.replace(sub, "").replace("\n\n", "\n")
    other = replace(project, settings=project.settings.model_copy(update={"main_tree": "Sub"}))
    assert written(other, newline) == TEXT.replace('to_execute="Main"', 'to_execute="Sub"')


def test_another_root(imported):
    project, _ = imported
    tree = Tree("Sub", "r", {"r": Node("r", "AlwaysFailure")})
    again = from_xml(to_xml(project.with_tree(tree)))
    assert again.trees["Sub"].nodes["r"].type == "AlwaysFailure"
    wrapped = project.trees["Main"]
    nodes = {**wrapped.nodes, "w": Node("w", "Inverter", children=("n1",))}
    again = from_xml(to_xml(project.with_tree(replace(wrapped, nodes=nodes, root="w"))))
    assert [node.type for node in again.main.walk()] == ["Inverter", "Sequence", "Foo", "AlwaysSuccess"]
    assert "<!-- first -->" in to_xml(project.with_tree(replace(wrapped, nodes=nodes, root="w")))


def test_a_document_that_nothing_changed_in_stays_byte_for_byte(imported):
    project, _ = imported
    [document] = source_documents(project)
    assert patch_document(document, project, added=[], main=None) == project.files[document.file]
