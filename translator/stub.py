"""Stubs: the Python of actions and control nodes that an imported tree uses and nobody has written yet."""

from __future__ import annotations

import json
import keyword
from typing import TYPE_CHECKING

from translator.catalog import PortModel
from translator.values import choices

if TYPE_CHECKING:
    from collections.abc import Iterable

    from translator.catalog import NodeModel

_PYTHON_TYPES = {"int": "int", "uint": "int", "double": "float", "bool": "bool", "string": "str"}
_BASES = {"control": "ControlNode", "decorator": "DecoratorNode"}
_ATTRIBUTES = {"input": "INPUT_PORTS", "output": "OUTPUT_PORTS", "inout": "INOUT_PORTS"}


def can_be_class(name: str) -> bool:
    """Returns whether a type of node can be the name of a Python class."""
    return name.isidentifier() and not keyword.iskeyword(name)


def stub_source(
    name: str, model: NodeModel | None, ports_seen: Iterable[str], *, kind: str = "action"
) -> str:
    """Returns the source of a node of `kind` that is still to be written, with the ports seen in the tree."""
    from tree_gardener.stubs import STUB_CONTROL_UPDATE, STUB_UPDATE  # noqa: PLC0415 - the engine loads py_trees

    seen = sorted(set(ports_seen))
    declared = list(model.ports.values()) if model is not None else []
    if declared:
        declared += [PortModel(port) for port in seen if port not in {item.name for item in declared}]
    doc = _docstring([] if declared else seen)
    if kind in _BASES:
        names = ", ".join(sorted({_BASES[kind], "Status", *(("Port",) if declared else ())}))
        head = [f"from tree_gardener import {names}", "", "", f"class {name}({_BASES[kind]}):", *doc, ""]
        return "\n".join([*head, *_declarations(declared), STUB_CONTROL_UPDATE])
    lines = ["import py_trees", ""]
    if declared:
        lines += ["from tree_gardener.ports import Port", ""]
    lines += ["", f"class {name}(py_trees.behaviour.Behaviour):", *doc, ""]
    if kind == "condition":
        lines += ['    NODE_KIND = "Condition"', ""]
    lines += [*_declarations(declared), *_METHODS, STUB_UPDATE]
    return "\n".join(lines)


_METHODS = (
    "    def __init__(self, name, ports=None):",
    "        super().__init__(name)",
    "        self.ports = ports or {}",
    "",
)


def _docstring(seen: list[str]) -> list[str]:
    from tree_gardener.stubs import STUB_MARK  # noqa: PLC0415 - as above

    if not seen:
        return [f'    """{STUB_MARK}."""']
    return [f'    """{STUB_MARK}.', "", f"    Ports seen in the imported tree: {', '.join(seen)}.", '    """']


def _declarations(ports: list[PortModel]) -> list[str]:
    lines = []
    for direction, attribute in _ATTRIBUTES.items():
        chosen = [port for port in ports if port.direction == direction]
        if chosen:
            lines += [
                f"    {attribute} = {{",
                *(f"        {_text(port.name)}: {_port(port)}," for port in chosen),
            ]
            lines += ["    }", ""]
    return lines


def _port(port: PortModel) -> str:
    arguments = [_python_type(port)] if port.type != "any" else []
    if port.default is not None:
        arguments.append(f"default={_text(port.default)}")
    if port.description:
        arguments.append(f"description={_text(port.description)}")
    return f"Port({', '.join(arguments)})"


def _python_type(port: PortModel) -> str:
    type_ = port.type
    if port.named and choices(type_) is not None:
        return _text(port.named)  # an enumeration of the project
    if type_.startswith("list["):
        return f"list[{_PYTHON_TYPES.get(type_[5:-1], 'str')}]"
    return _PYTHON_TYPES.get(type_, "str")


def _text(value: str) -> str:
    return json.dumps(value, ensure_ascii=False)
