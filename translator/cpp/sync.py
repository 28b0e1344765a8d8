"""Keeps a project in step with a plugin in C++: compares its nodes with the models that the plugin writes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from translator.catalog import NodeModel, PortModel, builtins
from translator.cpp.nodes import ANY, can_be_port, declared_ports
from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.enums import enum_type
from translator.stub import can_be_class, stub_source
from translator.xml.read import read_document
from translator.xml.write import EXPLICIT_TAGS, PORT_TAGS, cpp_type

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from translator.action import ActionModel
    from translator.project import Project

ABSENT = "–"


@dataclass(frozen=True, slots=True)
class InStep:
    """The stubs to write, by path, and the differences of actions that exist already."""

    files: Mapping[str, bytes] = field(default_factory=dict)
    diagnostics: tuple[Diagnostic, ...] = ()


def take_over(project: Project, xml: bytes | str, *, file: str = "models.xml") -> InStep:
    """Compares the project's nodes with the `TreeNodesModel` of a plugin or palette.

    A node that is missing, or only a stub, gets a stub with the ports of its model. Where the code of a node
    is written, differences are reported, and nothing is changed.

    Raises:
        TranslatorError: If the document cannot be read, or has no models.
    """
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    raw = xml.encode("utf-8", "surrogatepass") if isinstance(xml, str) else xml
    document = read_document(raw, file=file)
    models = {
        name: _with_enums(model, project.enums)
        for name, model in sorted(document.models.items())
        if model.kind != "subtree" and name not in builtins()
    }
    if not models:
        raise TranslatorError([diagnostic("BT0746", Place(file, line=1, column=1))])
    files: dict[str, bytes] = {}
    found = list(document.diagnostics)
    for name, model in models.items():
        action = project.actions.get(name)
        if action is None and not can_be_class(name):
            found.append(diagnostic("BT0747", Place(file, line=1), name=name))
            continue
        differing = list(_differing(action, model, file)) if action is not None else []
        if action is None or (is_stub(action.source) and (differing or _adds_ports(action, model))):
            path = action.path if action is not None else f"actions/{name}.py"
            files[path] = stub_source(name, model, (), kind=model.kind).encode()
            found.append(diagnostic("BT0743", Place(path, line=1), path=path, file=file, name=name))
        else:
            found.extend(differing)
    for name, action in sorted(project.actions.items()):
        if name not in models:
            found.append(diagnostic("BT0748", Place(action.path, line=action.line), file=file, name=name))
    return InStep(files, tuple(found))


def _with_enums(model: NodeModel, enums: Mapping[str, Mapping[str, int]]) -> NodeModel:
    """Returns the model with the types of ports that are enumerations of the project."""
    ports = {
        name: replace(port, type=enum_type(port.named, enums[port.named])) if port.named in enums else port
        for name, port in model.ports.items()
    }
    return replace(model, ports=ports)


def _differing(action: ActionModel, model: NodeModel, file: str) -> Iterator[Diagnostic]:
    """Yields the differences between an action and the model of its node."""
    place = Place(action.path, line=action.line)
    values = {"name": action.name, "file": file}
    ours_kind, theirs_kind = (EXPLICIT_TAGS.get(kind, "Action") for kind in (action.kind, model.kind))
    if ours_kind != theirs_kind:
        yield diagnostic("BT0745", place, ours=ours_kind, theirs=theirs_kind, **values)
    if action.open:
        return  # the class declares no ports: it takes any
    ours = {port.name: port for port in declared_ports(action) if can_be_port(port.name)}
    for name in sorted(ours.keys() | model.ports.keys()):
        one, other = ours.get(name), model.ports.get(name)
        if _facts(one) != _facts(other):
            shown = {"ours": _told(one, other), "theirs": _told(other, one)}
            yield diagnostic("BT0744", replace(place, port=name), port=name, **shown, **values)


def _adds_ports(action: ActionModel, model: NodeModel) -> bool:
    """Returns whether a model has details of ports that a class does not declare."""
    return action.open and not all(_says_nothing(port) for port in model.ports.values())


def _says_nothing(port: PortModel) -> bool:
    return _type(port) == ANY and port.default is None and not port.description


def _type(port: PortModel) -> str:
    return cpp_type(port.type) or port.named or ANY


def _facts(port: PortModel | None) -> object:
    return port and (*_meaning(port), port.description)


def _meaning(port: PortModel) -> tuple[str, str, str | None]:
    return port.direction, _type(port), port.default


def _told(port: PortModel | None, other: PortModel | None) -> str:
    """Returns a port in a few words: those of the XML, and the description where only it differs."""
    if port is None:
        return ABSENT
    words = f"{PORT_TAGS[port.direction]} {_type(port)}"
    if port.default is not None:
        words += f' "{port.default}"'
    alike = other is not None and _meaning(port) == _meaning(other)
    return f"{words} ({port.description or ABSENT})" if alike else words
