"""The ports that are tuned: `MainTree.Forward.lin_speed=0.1..0.6`, and their values in a project."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor.evaluation.variation import port_text, targets
from translator.check import check
from translator.diagnostic import errors_in

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from executor.evaluation.plan import Plan
    from translator import Project

    Value = float | int
_TEXT: Final = re.compile(r"(?P<address>[^=]+)=(?P<low>[^=]+?)\.\.(?P<high>[^=.]+(?:\.[^=.]+)?)")


class TuningError(Exception):
    """Something cannot be tuned; the text says what and why."""


@dataclass(frozen=True)
class Port:
    """A port that is tuned: its address, its place in the project, and its bounds."""

    address: str
    tree: str
    node: str
    port: str
    low: float
    high: float
    whole: bool = False

    def value(self, text: str) -> Value:
        """Returns a number of this port from its text."""
        return round(float(text)) if self.whole else float(text)


def read_ports(texts: Sequence[str], plan: Plan) -> list[Port]:
    """Returns the ports that the command line names.

    Raises:
        TuningError: a text is no port with bounds, or the bounds cannot be its values.
    """
    found = [_read(text, plan) for text in texts]
    seen: set[tuple[str, str, str]] = set()
    for port in found:
        key = (port.tree, port.node, port.port)
        if key in seen:
            raise TuningError(f"{port.address}: it is named twice")
        seen.add(key)
    return found


def _read(text: str, plan: Plan) -> Port:
    match = _TEXT.fullmatch(text)
    try:
        low, high = float(match["low"]), float(match["high"])  # type: ignore[index]  # None is a TypeError
    except (TypeError, ValueError):
        raise TuningError(
            f"{text}: write a port with its bounds, such as MainTree.Forward.lin_speed=0.1..0.6"
        ) from None
    address = match["address"].strip()  # type: ignore[index]  # it matched
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise TuningError(f"{text}: the bounds are two numbers, the lower one first")
    full = f"ports.{address.removeprefix('ports.')}"
    known = targets(plan.universe, plan.configs[0], plan.project)
    named = [target for target in known.get(full, []) if target.kind == "port"]
    if len(named) != 1:
        ports = sorted(each.removeprefix("ports.") for each in known if each.startswith("ports."))
        why = "several ports have this name" if named else "there is no such port"
        raise TuningError(f"{address}: {why}; there are {', '.join(ports[:20])}")
    [target] = named
    drawn = [name for name, each in plan.targets.items() if each == target]
    if drawn:
        raise TuningError(f"{address}: {plan.file} draws it (`vary`), so that it has no value to tune")
    tree, node = target.owner
    port = Port(address.removeprefix("ports."), tree, node, target.field, low, high, target.whole)
    for bound in (low, high):
        with_bound = apply(plan.project, {port: port.value(str(bound))})
        if errors := errors_in(check(with_bound)):
            raise TuningError(f"{address}: {bound:g} cannot be its value: {errors[0].message}")
    return port


def apply(project: Project, values: Mapping[Port, Value]) -> Project:
    """Returns a project whose ports have some values."""
    for port, value in values.items():
        tree = project.trees[port.tree]
        ports = {**tree.nodes[port.node].ports, port.port: port_text(value)}
        project = project.with_tree(tree.edited(port.node, ports=ports))
    return project


def today(project: Project, ports: Sequence[Port]) -> dict[str, str]:
    """Returns the present text of each port by its address; it is empty where a default holds."""
    return {
        port.address: project.trees[port.tree].nodes[port.node].ports.get(port.port, "") for port in ports
    }
