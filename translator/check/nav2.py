"""Checks that Nav2 has the nodes and ports of a project in the project's ROS distribution."""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.nav2.distributions import node_names, port_names, titled
from translator.nav2.models import Lack, distribution_for, lacks, uses_of, with_node

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.nav2.distributions import Distribution
    from translator.tree import Node, Tree


def check_nav2(context: Context) -> None:
    """Reports each block that is a node of Nav2 in another distribution, and each port that is."""
    uses = uses_of(context.project)
    if not uses:
        return
    distribution = distribution_for(context.project)
    found = set(lacks(uses, distribution))
    for tree in context.project.trees.values():
        for node in tree.walk():
            if Lack(node.type) in found:
                _report(context, tree, node, "", distribution)
            for port in node.ports:
                if Lack(node.type, port) in found:
                    _report(context, tree, node, port, distribution)


def _report(context: Context, tree: Tree, node: Node, port: str, distribution: Distribution) -> None:
    those = ", ".join(map(titled, with_node(node.type, port)))
    known = {"type": node.type, "distribution": titled(distribution), "those": those}
    if port:
        twin = _port_twin(node.type, port, distribution)
        context.report("BT0130", tree, node, port=port, twin=twin, **known)
    else:
        context.report("BT0129", tree, node, twin=_twin(node.type, distribution), **known)


def _twin(type_: str, distribution: Distribution) -> str:
    names = [name for name in node_names(type_)[1:] if distribution in with_node(name)]
    return names[0] if names else "none"


def _port_twin(type_: str, port: str, distribution: Distribution) -> str:
    names = [name for name in port_names(type_, port)[1:] if distribution in with_node(type_, name)]
    return names[0] if names else "none"
