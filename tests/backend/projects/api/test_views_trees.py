"""A tree as a diagram and as XML."""

from __future__ import annotations

import json

from backend.projects.api import views_trees

DIAGRAM = json.dumps({"id": "T", "root": "n1", "nodes": {"n1": {"type": "AlwaysSuccess"}}})


def test_a_diagram_becomes_xml_and_back(api):
    written = api.post("trees/xml", {"diagram": DIAGRAM})
    assert "<AlwaysSuccess" in written["xml"]
    read = api.post("trees/diagram", {"xml": written["xml"], "diagram": DIAGRAM})
    assert json.loads(read["diagram"])["nodes"].keys() == {"n1"}
    assert set(written) == set(views_trees.TreeTextSerializer().fields)
