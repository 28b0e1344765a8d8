"""Reads XML files with those that they include, and decides which of two trees of one ID runs."""

from __future__ import annotations

import posixpath
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.limits import XML_INCLUDES
from translator.xml.py_trees import included_path
from translator.xml.read import Document, read_document
from translator.xml.source import parse_source
from tree_gardener.packages import nearest, package_folders

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from translator.xml.source import Element

SUFFIXES = (".xml", ".btproj")


@dataclass(slots=True)
class Reading:
    """Documents read so far, by path, and the findings in them."""

    files: Mapping[str, bytes]
    documents: dict[str, Document] = field(default_factory=dict)
    found: list[Diagnostic] = field(default_factory=list)
    _packages: dict[str, list[str]] | None = None

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
            waiting.extend(reversed(list(self._included(document))))

    def _included(self, document: Document) -> Iterator[str]:
        """Yields the files that a document includes; reports those that cannot be read."""
        for element in document.includes:
            place = Place(document.file, line=element.line, column=element.column)
            path = element.attributes.get("path", "") or included_path(element)
            package = element.attributes.get("ros_pkg", "")
            target = self.target(document.file, element)
            if not path:
                self.found.append(diagnostic("BT0730", place))
            elif package and package not in self.packages:
                self.found.append(diagnostic("BT0731", place, package=package, path=path))
            elif target is None:
                self.found.append(diagnostic("BT0732", place, path=path))
            elif target not in self.files:
                self.found.append(diagnostic("BT0733", place, path=path))
            elif len(self.documents) > XML_INCLUDES:
                self.found.append(diagnostic("BT0708", place, limit=XML_INCLUDES))
            else:
                yield target

    @property
    def packages(self) -> dict[str, list[str]]:
        """The folders of the ROS packages among the files, by their names."""
        if self._packages is None:
            self._packages = package_folders(self.files)
        return self._packages

    def target(self, file: str, include: Element) -> str | None:
        """Returns the path of an included file; None if it lies outside of what was imported."""
        path = (include.attributes.get("path", "") or included_path(include)).replace("\\", "/")
        package = include.attributes.get("ros_pkg", "")
        folder = posixpath.dirname(file)
        if package:
            folder = nearest(self.packages.get(package, [""]), folder)
        target = posixpath.normpath(posixpath.join(folder, path))
        return None if posixpath.isabs(path) or target.startswith("../") else target

    def last_first(self) -> list[Document]:
        """Returns the documents against the order in which BehaviorTree.CPP reads them.

        It reads what a document includes before its own trees, and a later tree replaces one of the same ID.
        """
        calls = {
            path: [self.target(path, element) for element in document.includes]
            for path, document in self.documents.items()
        }
        included = {target for targets in calls.values() for target in targets}
        order: dict[str, None] = {}
        stack = [(path, False) for path in sorted(self.documents, key=lambda path: (path in included, path))]
        stack.reverse()
        seen: set[str] = set()
        while stack:
            path, is_read = stack.pop()
            if is_read:
                order[path] = None
            elif path not in seen:
                seen.add(path)
                stack.append((path, True))
                stack += [(target, False) for target in reversed(calls[path]) if target in calls]
        return [self.documents[path] for path in reversed(order)]

    def replaced(self) -> dict[tuple[str, str], Document]:
        """Returns the trees that a later document replaces, as file and ID, each with that document."""
        taken: dict[str, Document] = {}
        result: dict[tuple[str, str], Document] = {}
        for document in self.last_first():
            for item in document.trees:
                other = taken.setdefault(item.tree.id, document)
                if other is not document:
                    result[document.file, item.tree.id] = other
        return result


def tree_files(files: Mapping[str, bytes]) -> list[str]:
    """Returns the files that hold trees or models of nodes; one that cannot be read counts if it names any.

    Where there are projects of Groot2, only these.
    """
    paths = [path for path in sorted(files) if path.lower().endswith(SUFFIXES)]
    projects = [path for path in paths if path.lower().endswith(".btproj")]
    return projects or [path for path in paths if _holds_trees(files[path], path)]


def _holds_trees(raw: bytes, path: str) -> bool:
    try:
        root = parse_source(raw, file=path).root
    except TranslatorError:
        return any("BehaviorTree".encode(encoding) in raw for encoding in ("utf-8", "utf-16-le", "utf-16-be"))
    return root.tag.lower() == "root"


def uncalled(documents: Iterable[Document]) -> tuple[list[str], list[str]]:
    """Returns the trees that documents name as their main tree, and those that no other tree calls.

    Trees that were renamed, since a later one has their ID, are left out.
    """
    documents = list(documents)
    items = [item for document in documents for item in document.trees if not item.is_renamed]
    trees = {item.tree.id: item.tree for item in items}
    called = {node.tree for tree in trees.values() for node in tree.subtree_calls() if node.tree != tree.id}
    named = dict.fromkeys(document.main for document in documents if document.main in trees)
    return list(named), [tree_id for tree_id in trees if tree_id not in called]
