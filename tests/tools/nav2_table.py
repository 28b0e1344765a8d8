"""Makes the table of Nav2's nodes out of its model: `python -m tests.tools.nav2_table nav2_tree_nodes.xml`.

The model is `nav2_behavior_tree/nav2_tree_nodes.xml` of Nav2's repository. The table keeps the type, the kind
and the ports of each node, with direction, type, default and description.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any, Final
from xml.etree import ElementTree

TABLE: Final = Path(__file__).resolve().parents[2] / "tree_gardener" / "nav2_nodes.json"
DIRECTIONS: Final = {"input_port": "input", "output_port": "output", "bidirectional_port": "inout"}
INFINITY: Final = "numeric_limits<double>::infinity()"


def table_of(model: str) -> dict[str, Any]:
    """Returns the table of a model."""
    root = ElementTree.fromstring(model)  # noqa: S314 - a file that the developer chose
    nodes = [_node(element) for element in root.iterfind("TreeNodesModel/*")]
    return {"source": "Nav2, nav2_behavior_tree/nav2_tree_nodes.xml (Apache-2.0)", "nodes": nodes}


def _node(element: ElementTree.Element) -> dict[str, Any]:
    ports = [_port(port) for port in element]
    return {"type": element.attrib["ID"], "kind": element.tag.lower(), "ports": ports}


def _port(element: ElementTree.Element) -> dict[str, str]:
    port = {
        "name": element.attrib["name"],
        "direction": DIRECTIONS[element.tag],
        "type": element.attrib.get("type", ""),
    }
    if "default" in element.attrib:
        default = element.attrib["default"]
        port["default"] = "inf" if default == INFINITY else default.strip('"')
    return {**port, "description": " ".join((element.text or "").split())}


def table_text(table: dict[str, Any]) -> str:
    """Returns a table as the repository has it: a line for each port."""
    rows = []
    for node in table["nodes"]:
        head = f'{{"type": {json.dumps(node["type"])}, "kind": {json.dumps(node["kind"])}, "ports": ['
        ports = ",\n".join(f"  {json.dumps(port, ensure_ascii=False)}" for port in node["ports"])
        rows.append(f"{head}\n{ports}\n]}}" if ports else f"{head}]}}")
    source = json.dumps(table["source"])
    return f'{{"source": {source},\n"nodes": [\n' + ",\n".join(rows) + "\n]}\n"


if __name__ == "__main__":
    TABLE.write_text(table_text(table_of(Path(sys.argv[1]).read_text(encoding="utf-8"))), encoding="utf-8")
    print(TABLE)
