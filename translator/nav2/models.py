"""Nodes of Nav2 in trees: which of them there are, and which ROS distribution has them all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

from translator.action_kind import LIMITS
from translator.catalog import NodeModel, PortModel
from translator.nav2.distributions import DEFAULT, DISTRIBUTIONS, NEWEST
from translator.nav2.sources import TYPES
from translator.nav2.tables import table

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Set

    from translator.action import ActionModel
    from translator.nav2.distributions import Distribution
    from translator.project import Project

    Uses = Mapping[str, Set[str]]
    """The ports with which each type of node is used."""

# A single name, such as IsStuck, may be anyone's node.
LEAST_NODES: Final = 2


class Lack(NamedTuple):
    """A node that a distribution does not have, or with `port` a port of one that it has."""

    type: str
    port: str = ""

    def __str__(self) -> str:
        return f"{self.port} of {self.type}" if self.port else self.type


def nav2_models(
    seen: Uses, models: Mapping[str, NodeModel], distribution: Distribution = NEWEST
) -> dict[str, NodeModel]:
    """Returns the models of those nodes of a tree that are nodes of Nav2.

    Args:
        seen: The ports with which each type of node is used.
        models: The models in the document; a model that differs from Nav2's belongs to another node.
        distribution: The one whose nodes they are.
    """
    rows = table(distribution)
    found = {type_: _model(rows[type_]) for type_ in seen if type_ in rows}
    if len(found) < LEAST_NODES:
        return {}
    return {
        type_: model
        for type_, model in found.items()
        if seen[type_] <= model.ports.keys() and _agrees(model, models.get(type_))
    }


def recognised(seen: Uses) -> Distribution:
    """Returns the distribution that knows most nodes of imported trees.

    Among equals it is the default one, then the newest.
    """
    best = max((len(nav2_models(seen, {}, each)) for each in DISTRIBUTIONS), default=0)
    return next(each for each in _by_preference() if len(nav2_models(seen, {}, each)) == best)


def lacks(uses: Uses, distribution: Distribution) -> list[Lack]:
    """Returns what nodes of Nav2 use and a distribution does not have."""
    rows = table(distribution)
    found = []
    for type_, ports in uses.items():
        if type_ not in rows:
            found.append(Lack(type_))
            continue
        there = {port["name"] for port in rows[type_]["ports"]}
        found += [Lack(type_, port) for port in sorted(ports - there)]
    return found


def distribution_of(uses: Uses) -> Distribution | None:
    """Returns the default distribution if it has all nodes and ports, else the newest that has, or None."""
    return next((each for each in _by_preference() if not lacks(uses, each)), None)


def with_node(type_: str, port: str = "") -> list[Distribution]:
    """Returns the distributions that have a node, or a port of it."""
    return [each for each in DISTRIBUTIONS if not lacks({type_: {port} - {""}}, each)]


def is_of_nav2(action: ActionModel) -> bool:
    """Returns whether an action is a node of Nav2 from the library; the user may have changed it since."""
    return action.source.startswith(f'"""{action.name} of Nav2') and bool(with_node(action.name))


def uses_of(project: Project) -> dict[str, set[str]]:
    """Returns the nodes of Nav2 in the trees of a project, with the ports that are set."""
    ours = {name for name, action in project.actions.items() if is_of_nav2(action)}
    uses: dict[str, set[str]] = {}
    for tree in project.trees.values():
        for node in tree.nodes.values() if ours else ():
            if node.type in ours:
                uses.setdefault(node.type, set()).update(node.ports)
    return uses


def distribution_for(project: Project) -> Distribution:
    """Returns the distribution of a project: the one that it states, or else the one that its nodes need."""
    return project.settings.ros_distro or distribution_of(uses_of(project)) or NEWEST


def _by_preference() -> Iterable[Distribution]:
    return (DEFAULT, *(each for each in reversed(DISTRIBUTIONS) if each != DEFAULT))


def _agrees(model: NodeModel, own: NodeModel | None) -> bool:
    return own is None or (own.kind == model.kind and own.ports.keys() <= model.ports.keys())


def _model(row: Mapping[str, Any]) -> NodeModel:
    ports = {
        port["name"]: PortModel(
            name=port["name"],
            direction=port["direction"],
            type=TYPES.get(port["type"], "any"),
            default=port.get("default"),
            description=port["description"],
        )
        for port in row["ports"]
    }
    low, high = LIMITS.get(row["kind"], (0, 0))
    return NodeModel(row["type"], row["kind"], low, high, ports)
