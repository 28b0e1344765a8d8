"""Changes the ROS distribution of a project: nodes and ports of Nav2 get the names that they have there."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from translator.diagram import diagram_path, diagram_text
from translator.json_file import parse_json
from translator.nav2.distributions import node_names, port_names
from translator.nav2.models import Lack, is_of_nav2, lacks, uses_of
from translator.nav2.sources import nav2_source, sources
from translator.nav2.tables import table
from translator.project import Project, load
from translator.settings import PROJECT_FILE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.action import ActionModel
    from translator.nav2.distributions import Distribution
    from translator.tree import Node


class Changed(NamedTuple):
    """The result of a change of the distribution.

    Attributes:
        files: the files that it writes; None removes one.
        lacks: nodes and ports of the trees that the distribution does not have; they stay as they are.
        kept: nodes whose source the user has changed; it stays, under its name.
    """

    files: dict[str, bytes | None]
    lacks: list[Lack]
    kept: list[str]


def changed(files: Mapping[str, bytes], distribution: Distribution) -> Changed:
    """Returns the files of a project for another distribution.

    Raises:
        TranslatorError: the files are no project.
    """
    project = load(files)
    ours = {name: action for name, action in project.actions.items() if is_of_nav2(action)}
    kept = sorted(name for name, action in ours.items() if not _is_as_given(action))
    types = {name: _name_in(name, distribution) for name in ours if name not in kept}
    written: dict[str, bytes | None] = {PROJECT_FILE: _settings(files, distribution)}
    for name, new in types.items():
        if (source := nav2_source(new, distribution)) is not None:
            if new != name:
                written[f"actions/{name}.py"] = None
            written[f"actions/{new}.py"] = source.encode()
    for tree in project.trees.values():
        nodes = {key: _node(node, types, distribution) for key, node in tree.nodes.items()}
        if nodes != tree.nodes:
            written[diagram_path(tree.id)] = diagram_text(replace(tree, nodes=nodes)).encode()
    written = {path: raw for path, raw in written.items() if files.get(path) != raw}
    return Changed(written, _lacks(project, written, distribution), kept)


def _is_as_given(action: ActionModel) -> bool:
    return action.source.strip() in sources(action.name)


def _name_in(type_: str, distribution: Distribution) -> str:
    """Returns the name of a node in a distribution; the present one if it has none."""
    return next((name for name in node_names(type_) if name in table(distribution)), type_)


def _node(node: Node, types: Mapping[str, str], distribution: Distribution) -> Node:
    if node.type not in types:
        return node
    type_ = types[node.type]
    there = {port["name"] for port in table(distribution).get(type_, {"ports": ()})["ports"]}
    ports = {
        next((name for name in port_names(type_, port) if name in there), port): value
        for port, value in node.ports.items()
    }
    return replace(node, type=type_, ports=ports)


def _settings(files: Mapping[str, bytes], distribution: Distribution) -> bytes:
    """Returns `project.json` with the distribution; fields that this version does not know stay."""
    document, _ = parse_json(files.get(PROJECT_FILE, b"{}"), file=PROJECT_FILE)
    known = document if isinstance(document, dict) else {}
    return (json.dumps({**known, "ros_distro": distribution}, ensure_ascii=False, indent=2) + "\n").encode()


def _lacks(project: Project, written: Mapping[str, bytes | None], distribution: Distribution) -> list[Lack]:
    now = {path: raw for path, raw in {**project.files, **written}.items() if raw is not None}
    return lacks(uses_of(load(now)), distribution)
