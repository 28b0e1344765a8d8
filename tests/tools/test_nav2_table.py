"""The tool that makes the table of Nav2's nodes."""

from __future__ import annotations

import json

from tests.tools.nav2_table import table_of, table_text

MODEL = """<root BTCPP_format="4"><TreeNodesModel>
  <Action ID="Cut">
    <input_port name="far" type="double" default="numeric_limits&lt;double&gt;::infinity()">How
      far.</input_port>
    <output_port name="path" type="nav_msgs::msg::Path"/>
  </Action>
  <Condition ID="Low"><input_port name="topic" type="string" default="&quot;/b&quot;">Topic.</input_port></Condition>
  <Control ID="Both"/>
</TreeNodesModel></root>"""  # noqa: E501


def test_kind_ports_and_defaults_are_kept_and_the_text_is_the_table() -> None:
    table = table_of(MODEL)
    cut, low, both = table["nodes"]
    assert cut["ports"][0] == {
        "name": "far", "direction": "input", "type": "double", "default": "inf", "description": "How far.",
    }  # fmt: skip
    assert cut["ports"][1] == {
        "name": "path", "direction": "output", "type": "nav_msgs::msg::Path", "description": "",
    }  # fmt: skip
    assert (low["kind"], low["ports"][0]["default"]) == ("condition", "/b")
    assert both == {"type": "Both", "kind": "control", "ports": []}
    assert json.loads(table_text(table)) == table
