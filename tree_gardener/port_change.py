"""Changes the text of a port while the tree runs, between two ticks."""

import enum
from typing import Final

from tree_gardener.errors import Diagnostic, PortRefusedError
from tree_gardener.loader import bound_ports
from tree_gardener.node import Kind, Node
from tree_gardener.port_checks import PortProblem, check_text, declare_entry
from tree_gardener.ports import IDENTITY, NO_DEFAULT

READ_AT_LOAD: Final = "TG308"
"""The code of the refusal of a port that is read when the tree is built, and never again."""


class PortEffect(enum.Enum):
    """The time from which a node uses the new text of a port."""

    NEXT_TICK = "next_tick"
    NEXT_START = "next_start"
    """The action read the port before the first tick only: it reads it again when the tree is built again."""


def set_port(node: Node, name: str, text: str | None) -> PortEffect:
    """Gives a port another text, or none; it is checked as at load.

    Raises:
        PortRefusedError: the port does not take the text, or is read only when the tree is built.
    """
    problem = _problem(node, name, text)
    if problem is not None:
        raise PortRefusedError(_located(node, name, problem))
    others = {port: given for port, given in node.ports.items() if port != name}
    node.ports = others if text is None else {**others, name: text}
    effect = PortEffect.NEXT_START if name in node.early - node.ports_read else PortEffect.NEXT_TICK
    node.inputs.pop(name, None)
    if node.bound is not None:
        node.bound.replace(bound_ports(node))
    return effect


def _problem(node: Node, name: str, text: str | None) -> PortProblem | None:
    if node.KIND is Kind.SUBTREE or name == node.READ_AT_LOAD:
        message = f"the port '{name}' of {node.type} is read when the tree is built"
        return PortProblem(READ_AT_LOAD, message, "start the program again to use the new value")
    if node.manifest is None and name[:1].isalpha() and name not in IDENTITY:
        return None
    manifest = node.manifest or {}
    spec = manifest.get(name)
    if spec is None:
        known = ", ".join(manifest) or "it has none"
        return PortProblem("TG301", f"{node.type} has no port '{name}'", f"its ports: {known}")
    if text is None:
        is_needed = name == node.NEEDS or (spec.required and spec.default is NO_DEFAULT)
        message = f"the port '{name}' of {node.type} needs a value"
        return PortProblem("TG302", message, f'write {name}="…"') if is_needed else None
    return check_text(type(node), spec, text) or declare_entry(type(node), spec, text, node.board)


def _located(node: Node, port: str, problem: PortProblem) -> Diagnostic:
    return Diagnostic(
        problem.code,
        problem.message,
        problem.hint,
        file="",
        tree=node.tree_id,
        node=node.type,
        node_id=node.node_id,
        port=port,
    )
