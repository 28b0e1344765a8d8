"""Imports BehaviorTree.CPP XML into a project: includes, Groot2 projects, stubs for actions."""

from __future__ import annotations

import json
import posixpath
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from translator.action_kind import LIMITS
from translator.catalog import NodeModel, builtins, nearest
from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.diagram import diagram_path, diagram_text
from translator.enums import ENUMS_FILE, enums_text
from translator.limits import NAME_CHARACTERS, XML_INCLUDES, oversize
from translator.nav2 import nav2_models, nav2_source
from translator.project import Project, assemble
from translator.proposal import propose
from translator.settings import PROJECT_FILE, Settings
from translator.stub import can_be_class, stub_source
from translator.tree import Tree, used_types
from translator.xml.read import Document, read_document

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


IMPORTS = "imports/"


@dataclass(slots=True)
class _Import:
    """Documents read so far, by path, and the findings in them."""

    files: Mapping[str, bytes]
    documents: dict[str, Document] = field(default_factory=dict)
    found: list[Diagnostic] = field(default_factory=list)

    def read(self, path: str) -> None:
        """Reads a file and all files that it includes, each once."""
        waiting = [path]
        while waiting:
            current = waiting.pop()
            if current in self.documents:
                continue
            document = read_document(self.files[current], file=current)
            self.documents[current] = document
            self.found.extend(document.diagnostics)
            waiting.extend(reversed(list(self.included(document))))

    def included(self, document: Document) -> Iterable[str]:
        """Yields the files that a document includes; reports those that cannot be read."""
        folder = posixpath.dirname(document.file)
        for element in document.includes:
            place = Place(document.file, line=element.line, column=element.column)
            path = element.attributes.get("path", "")
            package = element.attributes.get("ros_pkg", "")
            target = posixpath.normpath(posixpath.join(folder, path.replace("\\", "/")))
            if not path:
                self.found.append(diagnostic("BT0730", place))
            elif package:
                self.found.append(diagnostic("BT0731", place, package=package, path=path))
            elif posixpath.isabs(path) or target.startswith("../"):
                self.found.append(diagnostic("BT0732", place, path=path))
            elif target not in self.files:
                self.found.append(diagnostic("BT0733", place, path=path))
            elif len(self.documents) > XML_INCLUDES:
                self.found.append(diagnostic("BT0708", place, limit=XML_INCLUDES))
            else:
                yield target


def from_xml(  # noqa: PLR0913 - each is a choice of its own, and keyword-only
    xml: bytes | str,
    *,
    file: str = "tree.xml",
    included: Mapping[str, bytes] | None = None,
    actions: Mapping[str, bytes] | None = None,
    stubs: bool = True,
    places: str = IMPORTS,
) -> Project:
    """Makes a project from a BehaviorTree.CPP document, v3 or v4, or from a Groot2 project.

    Args:
        xml: The document.
        file: Its path, to which the paths of `<include>` are relative.
        included: The files that it may include, by path.
        actions: Sources of actions by file name, such as `Forward.py`.
        stubs: Whether a missing action gets the source of Nav2's node of that name, if there is one, or a
            stub.
        places: The prefix of a file's path in places of findings. If it is "", findings of checks have places
            in the diagrams of the new project, otherwise in the XML.

    Raises:
        TranslatorError: If the text is not a readable behaviour tree.
    """
    raw = xml.encode("utf-8", "surrogatepass") if isinstance(xml, str) else xml
    work = _Import({**(included or {}), file: raw})
    work.read(file)
    trees, settings = _merged(work, file)
    models = [model for document in work.documents.values() for model in document.models.values()]
    if not trees and models:
        work.found.append(diagnostic("BT0741", Place(file, line=1, column=1), count=len(models)))
        trees = [Tree(settings.main_tree, None, {})]
    if not trees:
        raise TranslatorError([*work.found, diagnostic("BT0734", Place(file, line=1, column=1))])
    if too_large := oversize(trees, Place(file, line=1, column=1)):
        raise TranslatorError([*work.found, *too_large])
    documents = list(work.documents.values())
    sources = _actions(trees, documents, actions or {}, stubs=stubs)
    settings, proposed = with_proposal(settings, trees, sources)
    work.found.extend(proposed)
    files = {f"{IMPORTS}{path}": work.files[path] for path in work.documents}
    files.update(project_files(settings, trees))
    files.update(sources)
    enums = {name: members for document in documents for name, members in document.enums.items()}
    if enums:
        files[ENUMS_FILE] = enums_text(enums).encode()
    project = assemble(settings, (_placed(tree, places) for tree in trees), files)
    found = [item.moved(file=f"{places}{item.place.file}") for item in work.found]
    return replace(project, diagnostics=(*found, *project.diagnostics))


def _placed(tree: Tree, places: str) -> Tree:
    """Sets the places of a tree's nodes: in the XML, or in the diagram made from it."""
    if places != IMPORTS:
        return replace(tree, file=f"{places}{tree.file}")
    nodes = {key: replace(node, span=None) for key, node in tree.nodes.items()}
    return replace(tree, nodes=nodes, file=diagram_path(tree.id))


def with_proposal(
    settings: Settings, trees: Iterable[Tree], files: Mapping[str, bytes]
) -> tuple[Settings, list[Diagnostic]]:
    """Selects the universe, and the robot, that suit the topics of the actions that the trees use."""
    used = used_types(trees)
    actions = {path: raw for path, raw in files.items() if _action_name(path) in used}
    proposal = propose(actions, hints=[settings.name])
    if proposal is None:
        return settings, []
    chosen = {"universe": proposal.universe, "robot": proposal.robot}
    place = Place(PROJECT_FILE, line=1)
    note = diagnostic("BT0742", place, universe=proposal.universe, topics=proposal.reason)
    return settings.model_copy(update=chosen), [note]


def _action_name(path: str) -> str:
    return path.removeprefix("actions/").removesuffix(".py") if path.endswith(".py") else ""


def project_files(settings: Settings, trees: Iterable[Tree]) -> dict[str, bytes]:
    """Returns `project.json` and the diagrams."""
    text = json.dumps(settings.to_json(), ensure_ascii=False, indent=2) + "\n"
    files = {PROJECT_FILE: text.encode()}
    for tree in trees:
        files[diagram_path(tree.id)] = diagram_text(tree).encode()
    return files


def _merged(work: _Import, file: str) -> tuple[list[Tree], Settings]:
    """Joins the trees of all documents; if two have the same id, the first one is used."""
    trees: dict[str, Tree] = {}
    for document in work.documents.values():
        for item in document.trees:
            if len(item.tree.id) > NAME_CHARACTERS:
                place = Place(document.file, line=item.element.line, column=1)
                raise TranslatorError([*work.found, diagnostic("BT0736", place, limit=NAME_CHARACTERS)])
            if item.tree.id in trees:
                place = Place(document.file, tree=item.tree.id, line=item.element.line)
                work.found.append(
                    diagnostic("BT0015", place, id=item.tree.id, other=trees[item.tree.id].file)
                )
                continue
            trees[item.tree.id] = item.tree
    first = work.documents[file]
    named, main = main_tree_of(work.documents.values())
    if main != named and (named or len(trees) > 1):
        work.found.append(diagnostic("BT0735", Place(file, line=1), main=named or "(none)", chosen=main))
    name = first.source.root.attributes.get("project_name") or PurePosixPath(file).stem
    return list(trees.values()), Settings(
        name=name[:NAME_CHARACTERS] or "Untitled", main_tree=main or "MainTree"
    )


def main_tree_of(documents: Iterable[Document]) -> tuple[str, str]:
    """Returns the main tree that the documents name, and the one to use: the same, if it exists."""
    documents = list(documents)
    trees = {item.tree.id: item.tree for document in documents for item in document.trees}
    named = next((document.main for document in documents if document.main), "")
    if named in trees or not trees:
        return named, named
    called = {node.tree for tree in trees.values() for node in tree.subtree_calls()}
    return named, next((tree_id for tree_id in trees if tree_id not in called), next(iter(trees)))


def _actions(
    trees: list[Tree], documents: list[Document], sources: Mapping[str, bytes], *, stubs: bool
) -> dict[str, bytes]:
    """Returns the action files: given ones, those of `<Code>`, those of Nav2, and stubs for the others."""
    files = {f"actions/{name}": raw for name, raw in sources.items()}
    for document in documents:
        for name, code in document.code.items():
            if can_be_class(name):
                files.setdefault(f"actions/{name}.py", code.encode())
    models: dict[str, NodeModel] = {}
    kinds: dict[str, str] = {}
    for document in documents:
        models.update(document.models)
        kinds.update(document.kinds)
    seen = _unknown_nodes(trees)
    if not any(tree.nodes for tree in trees):  # a palette
        others = (name for name, model in models.items() if model.kind != "subtree")
        seen |= {name: _Use() for name in others if name not in builtins() and can_be_class(name)}
    nav2 = nav2_models({type_: use.ports for type_, use in seen.items()}, models) if stubs else {}
    for type_, use in seen.items() if stubs else ():
        path = f"actions/{type_}.py"
        if type_ in nav2 and (source := nav2_source(type_)) is not None:
            files.setdefault(path, source.encode())
            continue
        model = models.get(type_) or nav2.get(type_)
        if model is None and type_ not in kinds and use.children and nearest(type_, _with_children()):
            continue  # more likely a built-in node that is spelled wrong
        kind = model.kind if model is not None else kinds.get(type_, use.kind)
        if use.children and kind not in LIMITS:
            kind = use.kind  # a leaf could not have the children
        if path not in files:
            files[path] = stub_source(type_, model, use.ports, kind=kind).encode()
    return files


@dataclass(slots=True)
class _Use:
    """The ports and the largest number of children with which a type of node is used."""

    ports: set[str] = field(default_factory=set)
    children: int = 0

    @property
    def kind(self) -> str:
        """The kind of node that suits this use."""
        return "control" if self.children > 1 else "decorator" if self.children else "action"


def _with_children() -> list[str]:
    return [name for name, model in builtins().items() if model.max_children != 0]


def _unknown_nodes(trees: list[Tree]) -> dict[str, _Use]:
    """Returns the types of nodes that are not built in, with their ports and numbers of children."""
    ids = {tree.id for tree in trees}
    seen: dict[str, _Use] = {}
    for tree in trees:
        for node in tree.nodes.values():
            if node.type in builtins() or node.type in ids or not can_be_class(node.type):
                continue
            use = seen.setdefault(node.type, _Use())
            use.ports.update(node.ports)
            use.children = max(use.children, len(node.children))
    return dict(sorted(seen.items()))
