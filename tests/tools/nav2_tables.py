"""Makes the tables of Nav2's nodes: `make nav2-tables SOURCE=FOLDER`, FOLDER being a clone of Nav2.

Read is `nav2_behavior_tree/nav2_tree_nodes.xml` of the branch of each ROS distribution. A table keeps branch,
commit and SHA-256 of the file, and of each node the type, the kind, and the ports with direction, type,
default and description. Humble and Kilted leave out types and defaults; those of the newest distribution that
has the port, perhaps under its new name, take their place. What a file says otherwise than its nodes do
stands in `DEFAULTS` and `UNLISTED`.

`python -m tests.tools.nav2_tables --check FOLDER` says whether the tables are those of the clone.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final
from xml.etree import ElementTree

from translator.nav2.distributions import DISTRIBUTIONS, NEWEST, Distribution, new_node, new_port
from translator.nav2.tables import place_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

MODEL: Final = "nav2_behavior_tree/nav2_tree_nodes.xml"
DIRECTIONS: Final = {"input_port": "input", "output_port": "output", "bidirectional_port": "inout"}
INFINITY: Final = "numeric_limits<double>::infinity()"
DEFAULTS: Final = {
    ("humble", "TruncatePathLocal", "robot_frame"): "base_link",
    ("kilted", "IsPathValid", "max_cost"): "253",
    ("kilted", "TruncatePathLocal", "robot_frame"): "base_link",
}
"""What `providedPorts` in the nodes' headers says, where the file leaves it out and a newer one differs."""
UNLISTED: Final[dict[tuple[Distribution, str], tuple[str, ...]]] = {
    ("humble", "Spin"): ("is_recovery",),
    ("humble", "TruncatePathLocal"): ("input_path",),
    ("kilted", "AssistedTeleop"): ("error_msg",),
    ("kilted", "ComputeAndTrackRoute"): ("execution_duration",),
}
"""Ports that the nodes have and the file lacks; a tree that Nav2 ships for Humble uses the first."""

_Nodes = dict[str, dict[str, Any]]


def table_of(model: str, branch: str = "", commit: str = "") -> dict[str, Any]:
    """Returns the table of a model, as far as that says it."""
    root = ElementTree.fromstring(model)  # noqa: S314 - a file that the developer chose
    return {
        "source": "Nav2, nav2_behavior_tree/nav2_tree_nodes.xml (Apache-2.0)",
        "branch": branch,
        "commit": commit,
        "sha256": hashlib.sha256(model.encode()).hexdigest(),
        "nodes": [_node(element) for element in root.iterfind("TreeNodesModel/*")],
    }


def filled(tables: Mapping[Distribution, dict[str, Any]]) -> dict[Distribution, dict[str, Any]]:
    """Returns the tables by distribution, each type and default in its place.

    Raises:
        ValueError: a table has a node twice.
    """
    known = {name: _by_type(name, table["nodes"]) for name, table in tables.items()}
    for (name, type_), ports in UNLISTED.items():
        known[name][type_]["ports"] += [
            port for port in known[NEWEST][type_]["ports"] if port["name"] in ports
        ]
    for name, nodes in known.items():
        for node in nodes.values():
            node["ports"] = [_filled(name, node["type"], port, known) for port in node["ports"]]
    return dict(tables)


def _by_type(name: str, nodes: Iterable[dict[str, Any]]) -> _Nodes:
    found: _Nodes = {}
    for node in nodes:
        if found.setdefault(node["type"], node) is not node:
            raise ValueError(f"{name}: {node['type']} is there twice")
    return found


def _filled(
    name: Distribution, type_: str, port: dict[str, str], known: Mapping[Distribution, _Nodes]
) -> dict[str, str]:
    if port["type"]:
        return port
    twins = (
        (each, nodes.get(node))
        for each, nodes in reversed(list(known.items()))
        for node in (type_, new_node(type_))
    )
    for each, twin in twins:
        for other in twin["ports"] if twin is not None and each != name else ():
            if other["type"] and other["name"] in {port["name"], new_port(type_, port["name"])}:
                kept = {"name": port["name"], "direction": port["direction"], "type": other["type"]}
                default = DEFAULTS.get((name, type_, port["name"]), other.get("default"))
                kept |= {} if default is None else {"default": default}
                return {**kept, "description": port["description"] or other["description"]}
    return port


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
    head = "".join(f"{json.dumps(key)}: {json.dumps(table[key])},\n" for key in table if key != "nodes")
    return f'{{{head}"nodes": [\n' + ",\n".join(rows) + "\n]}\n"


def tables_in(clone: Path) -> dict[Distribution, str]:
    """Returns the text of each distribution's table, from a clone of Nav2 with its branches.

    Raises:
        ValueError: it lacks a branch, or the file of one.
    """
    found: dict[Distribution, dict[str, Any]] = {}
    for name in DISTRIBUTIONS:
        branch = branch_in(clone, name)
        commit, model = git(clone, "rev-parse", branch).strip(), git(clone, "show", f"{branch}:{MODEL}")
        if not branch or not model:
            raise ValueError(f"{clone} has no {MODEL} in the branch {name}: clone Nav2 with all its branches")
        found[name] = table_of(model, name, commit)
    return {name: table_text(table) for name, table in filled(found).items()}


def branch_in(clone: Path, name: Distribution) -> str:
    """Returns the branch of a distribution in a clone, its own or that of its origin; "" if there is none."""
    places = (name, f"origin/{name}")
    return next((each for each in places if git(clone, "rev-parse", "-q", "--verify", each)), "")


def git(clone: Path, *arguments: str) -> str:
    """Returns what git writes; "" if it fails."""
    command = ["git", "-C", str(clone), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    return done.stdout if done.returncode == 0 else ""


def main(arguments: Sequence[str] | None = None) -> int:
    """Writes the tables, or says which of them differ."""
    parser = argparse.ArgumentParser(prog="nav2_tables", description=__doc__.partition("\n")[0])
    parser.add_argument("clone", type=Path, metavar="FOLDER")
    parser.add_argument("--check", action="store_true", help="say which tables differ, and write nothing")
    options = parser.parse_args(arguments)
    try:
        tables = tables_in(options.clone)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    differ = [name for name, text in tables.items() if place_of(name).read_text(encoding="utf-8") != text]
    if options.check:
        print(
            f"other than the clone's: {', '.join(differ)}" if differ else "all tables are those of the clone"
        )
        return 1 if differ else 0
    for name, text in tables.items():
        place_of(name).write_text(text, encoding="utf-8")
        print(f"{place_of(name).name}: {name}{' (newest)' if name == NEWEST else ''}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
