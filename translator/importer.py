"""Imports BehaviorTree.CPP XML into a project: includes, Groot2 projects, stubs for actions."""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from translator.action_kind import LIMITS
from translator.catalog import NodeModel, builtins, nearest
from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.diagram import diagram_path, diagram_text
from translator.enums import ENUMS_FILE, enums_text
from translator.limits import NAME_CHARACTERS, oversize
from translator.nav2.distributions import DEFAULT, DISTRIBUTIONS, titled
from translator.nav2.models import Lack, lacks, nav2_models, recognised
from translator.nav2.sources import nav2_source
from translator.project import Project, assemble
from translator.proposal import propose
from translator.settings import PROJECT_FILE, Settings
from translator.stub import can_be_class, stub_source
from translator.tree import Tree, used_types
from translator.xml.includes import Reading, uncalled
from translator.xml.py_trees import class_source, with_defaults

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from translator.nav2.distributions import Distribution
    from translator.xml.read import Document

IMPORTS = "imports/"


def from_xml(  # noqa: PLR0913 - each is a choice of its own, and keyword-only
    xml: bytes | str,
    *,
    file: str = "tree.xml",
    included: Mapping[str, bytes] | None = None,
    main: str = "",
    actions: Mapping[str, bytes] | None = None,
    stubs: bool = True,
    places: str = IMPORTS,
) -> Project:
    """Makes a project from a BehaviorTree.CPP document, v3 or v4, or from a Groot2 project.

    Args:
        xml: The document.
        file: Its path, to which the paths of `<include>` are relative.
        included: The files that it may include, by path.
        main: The main tree; if it is "", the one that the document names, or the first that no other calls.
        actions: Sources of actions by file name, such as `Forward.py`.
        stubs: Whether a missing action gets the source of Nav2's node of that name, if there is one, or a
            stub.
        places: The prefix of a file's path in places of findings. If it is "", findings of checks have places
            in the diagrams of the new project, otherwise in the XML.

    Raises:
        TranslatorError: If the text is not a readable behaviour tree.
    """
    raw = xml.encode("utf-8", "surrogatepass") if isinstance(xml, str) else xml
    files = {**(included or {}), file: raw}
    return from_files([file], files, main=main, actions=actions, stubs=stubs, places=places)


def from_files(  # noqa: PLR0913 - each is a separate choice, and keyword-only
    entries: Sequence[str],
    files: Mapping[str, bytes],
    *,
    name: str = "",
    main: str = "",
    actions: Mapping[str, bytes] | None = None,
    stubs: bool = True,
    places: str = IMPORTS,
) -> Project:
    """Makes a project from documents that a program reads one after the other, as `from_xml` from one.

    Args:
        entries: The paths of the documents.
        files: These, and the files that they may include, by path.
        name: The name of the project; if it is "", that of the document with the main tree.
        main: The main tree, or "".
        actions: As for `from_xml`.
        stubs: As for `from_xml`.
        places: As for `from_xml`.

    Raises:
        TranslatorError: If a document is not a readable behaviour tree, or the main tree has to be named.
    """
    work = Reading(files)
    for entry in entries:
        work.read(entry)
    file = entries[0]
    trees, settings = _merged(work, list(entries), main, name)
    models = [model for document in work.documents.values() for model in document.models.values()]
    if not trees and models:
        work.found.append(diagnostic("BT0741", Place(file, line=1, column=1), count=len(models)))
        trees = [Tree(settings.main_tree, None, {})]
    if not trees:
        raise TranslatorError([*work.found, diagnostic("BT0734", Place(file, line=1, column=1))])
    if too_large := oversize(trees, Place(file, line=1, column=1)):
        raise TranslatorError([*work.found, *too_large])
    documents = list(work.documents.values())
    nav2 = _Nav2.of(trees, documents) if stubs else _Nav2()
    work.found.extend(nav2.notes(Place(file, line=1, column=1)))
    sources = _actions(trees, documents, actions or {}, nav2, stubs=stubs)
    settings, proposed = with_proposal(settings, trees, sources)
    settings = settings.model_copy(update={"ros_distro": nav2.distribution})
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


def _merged(work: Reading, entries: list[str], main: str, name: str) -> tuple[list[Tree], Settings]:
    """Joins the trees of all documents; if two have the same ID, the one that is read last is used."""
    trees: dict[str, Tree] = {}
    replaced = work.replaced()
    for document in work.documents.values():
        for item in document.trees:
            place = Place(document.file, tree=item.tree.id, line=item.element.line, column=1)
            if len(item.tree.id) > NAME_CHARACTERS:
                raise TranslatorError([*work.found, diagnostic("BT0736", place, limit=NAME_CHARACTERS)])
            other = replaced.get((document.file, item.tree.id))
            if other is not None:
                work.found.append(diagnostic("BT0726", place, id=item.tree.id, other=other.file))
            else:
                trees[item.tree.id] = item.tree
    if main or len(entries) > 1:
        main = _chosen(work, entries, main)
    else:
        named, main = main_tree_of(work.documents.values())
        if main != named and (named or len(trees) > 1):
            place = Place(entries[0], line=1)
            work.found.append(diagnostic("BT0735", place, main=named or "(none)", chosen=main))
    first = work.documents[entries[0]].source.root if len(entries) == 1 else None
    name = (
        (first.attributes.get("project_name", "") if first else "") or name or PurePosixPath(entries[0]).stem
    )
    foreign = [document for document in work.documents.values() if document.is_of_py_trees]
    if foreign:
        trees = with_defaults(trees, _ids(foreign), main)
    return list(trees.values()), Settings(
        name=name[:NAME_CHARACTERS] or "Untitled", main_tree=main or "MainTree"
    )


def _chosen(work: Reading, entries: list[str], main: str) -> str:
    """Returns the main tree of several documents: the named one, or the only one that no other calls.

    Raises:
        TranslatorError: It is not among the trees, or has to be chosen: of trees with one ID, by the file.
    """
    documents = work.documents.values()
    named, tops = uncalled(documents)
    both = [tree_id for tree_id in named if tree_id in tops]
    choices = tops if len(tops) == 1 else both or tops or named or _ids(documents)
    files = {
        tree_id: [doc.file for doc in documents if any(item.tree.id == tree_id for item in doc.trees)]
        for tree_id in choices
    }
    if main:
        if main in _ids(documents):
            return main
        place = Place(entries[0], line=1, column=1)
        raise TranslatorError([diagnostic("BT0727", place, main=main, choices=", ".join(choices))])
    if len(choices) == 1 and len(set(files[choices[0]]) & set(entries)) == 1:
        return choices[0]
    raise TranslatorError(
        [
            diagnostic(
                *("BT0924", Place(file, tree=tree_id, line=1, column=1)),
                choice=tree_id if len(files[tree_id]) == 1 else file,
            )
            for tree_id in choices
            for file in files[tree_id]
        ]
    )


def _ids(documents: Iterable[Document]) -> list[str]:
    return list(dict.fromkeys(item.tree.id for document in documents for item in document.trees))


def main_tree_of(documents: Iterable[Document]) -> tuple[str, str]:
    """Returns the main tree that the documents name, and the one to use: the same, if it exists."""
    documents = list(documents)
    trees = _ids(documents)
    named = next((document.main for document in documents if document.main), "")
    if named in trees or not trees:
        return named, named
    return named, next(iter(uncalled(documents)[1]), trees[0])


@dataclass(frozen=True, slots=True)
class _Nav2:
    """The nodes of Nav2 in imported trees, the ROS distribution that has most of them, and what it lacks."""

    distribution: Distribution = DEFAULT
    models: Mapping[str, NodeModel] = field(default_factory=dict)
    lacks: Sequence[Lack] = ()

    @classmethod
    def of(cls, trees: list[Tree], documents: list[Document]) -> _Nav2:
        seen = {type_: use.ports for type_, use in _seen(trees, documents).items()}
        own = {name: model for document in documents for name, model in document.models.items()}
        distribution = recognised(seen)
        models = nav2_models(seen, own, distribution)
        if not models:
            return cls()
        for each in reversed(DISTRIBUTIONS):
            models = nav2_models(seen, own, each) | models
        return cls(distribution, models, lacks({name: seen[name] for name in models}, distribution))

    def notes(self, place: Place) -> list[Diagnostic]:
        if not self.models:
            return []
        name = titled(self.distribution)
        if self.lacks:
            return [diagnostic("BT0750", place, distribution=name, lacks=", ".join(map(str, self.lacks)))]
        return [diagnostic("BT0749", place, distribution=name)]

    def source(self, type_: str) -> str | None:
        """Returns the source in this distribution, or in the newest that has the node."""
        if type_ not in self.models:
            return None
        those = (self.distribution, *reversed(DISTRIBUTIONS))
        return next((text for each in those if (text := nav2_source(type_, each)) is not None), None)


def _seen(trees: list[Tree], documents: list[Document]) -> dict[str, _Use]:
    """Returns the nodes that are not built in; of a palette, its models."""
    seen = _unknown_nodes(trees)
    if not any(tree.nodes for tree in trees):  # a palette
        models = {name: model for document in documents for name, model in document.models.items()}
        others = (name for name, model in models.items() if model.kind != "subtree")
        seen |= {name: _Use() for name in others if name not in builtins() and can_be_class(name)}
    return seen


def _actions(
    trees: list[Tree], documents: list[Document], sources: Mapping[str, bytes], nav2: _Nav2, *, stubs: bool
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
    for type_, use in _seen(trees, documents).items() if stubs else ():
        path = f"actions/{type_}.py"
        if (source := nav2.source(type_)) is not None:
            files.setdefault(path, source.encode())
            continue
        if (
            any(document.is_of_py_trees for document in documents)
            and (made := class_source(type_)) is not None
        ):
            files.setdefault(path, made)
            continue
        model = models.get(type_) or nav2.models.get(type_)
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
