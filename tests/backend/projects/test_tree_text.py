"""Trees as text over HTTP."""

from __future__ import annotations

import json

DIAGRAM = json.dumps(
    {
        "format": "bt-studio/diagram",
        "version": 1,
        "id": "Main",
        "root": "n1",
        "nodes": {"n1": {"type": "Inverter", "children": ["n2"]}, "n2": {"type": "Stop", "position": [1, 2]}},
    }
)


def test_a_tree_goes_to_text_and_back(api):
    text = api.post("trees/xml", {"diagram": DIAGRAM})
    assert [found["node"] for found in text["ranges"]] == ["n1", "n2"]
    xml = text["xml"].replace("<Stop", "<!-- halt -->\n      <Go")
    read = api.post("trees/diagram", {"diagram": DIAGRAM, "xml": xml})
    nodes = json.loads(read["diagram"])["nodes"]
    assert nodes["n2"] == {"type": "Go", "position": [1, 2]}
    ids = [found["node"] for found in read["ranges"]]
    again = api.post("trees/xml", {"diagram": DIAGRAM, "base": xml, "ids": ids})
    assert again["xml"] == xml.replace("<Go", "<Stop")


def test_text_that_cannot_be_read_is_reported_at_its_line(api):
    half = api.post("trees/diagram", {"diagram": DIAGRAM, "xml": "<root>\n<"})
    assert half["diagram"] is None
    assert half["diagnostics"][0]["line"] == 2
    api.post("trees/diagram", {"diagram": "[]", "xml": "<root/>"}, expect=422)
    refused = api.post("trees/xml", {"diagram": "[]"}, expect=422)
    assert refused["diagnostics"][0]["code"] == "BT0004"
