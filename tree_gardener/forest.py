"""Documents that belong together: a main document, its includes, and documents registered before it."""

import pathlib
from collections.abc import Mapping, Sequence
from typing import Any

from tree_gardener.actions import load_actions
from tree_gardener.document import Document, Element, embedded_modules, embedded_sources, parse_document
from tree_gardener.enums import read_enums
from tree_gardener.errors import Diagnostic, LoadError
from tree_gardener.registry import NodeType
from tree_gardener.structure import Definition, StructureCheck, SubTreeModel


class Forest:
    """All trees and models of some documents.

    Attributes:
        definitions: the trees by ID; if two have the same ID, the last one counts.
        models: the models of the SubTrees, by tree ID.
        sources: the sources of the actions in the documents, by name.
        modules: the sources that these actions import, by name.
        enums: the enumerations in the documents, by name.
        main: the document that names the main tree.
    """

    def __init__(self) -> None:
        self.documents: list[Document] = []
        self.definitions: dict[str, Definition] = {}
        self.models: dict[str, SubTreeModel] = {}
        self.sources: dict[str, str] = {}
        self.modules: dict[str, str] = {}
        self.enums: dict[str, dict[str, int]] = {}
        self.main: Document | None = None
        self._first: Document | None = None
        self._main_from = 0
        self._new: list[Definition] = []

    def read(self, text: str | bytes, name: str, base_path: pathlib.Path | None) -> None:
        """Parses a document and its includes; the document that is read last is the main one."""
        self._main_from = len(self.documents)
        self.main = self._read(text, name, base_path, [])
        self._first = self._first or self.main

    def read_all(
        self,
        documents: Sequence[str | bytes],
        text: str | bytes,
        name: str,
        base_path: str | pathlib.Path | None,
    ) -> None:
        """Parses a main document, and before it others, whose trees it can use."""
        base = pathlib.Path(base_path) if base_path is not None else None
        for index, document in enumerate(documents):
            self.read(document, f"document {index + 1}", base)
        self.read(text, name, base)

    def with_actions(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Returns the given classes, and those of the actions whose sources are in the documents."""
        missing = {action: source for action, source in self.sources.items() if action not in given}
        loaded = load_actions({**self.modules, **missing}, only=missing) if missing else {}
        return {**given, **loaded}

    def _read(
        self, text: str | bytes, name: str, base_path: pathlib.Path | None, above: list[pathlib.Path]
    ) -> Document:
        document = parse_document(text, name)
        self.sources.update(embedded_sources(document))
        self.modules.update(embedded_modules(document))
        self.enums.update(read_enums(document))
        for element in document.root.children:
            if element.tag == "include":
                self._include(document, element, base_path, above)
        self.documents.append(document)
        return document

    def _include(
        self, document: Document, element: Element, base_path: pathlib.Path | None, above: list[pathlib.Path]
    ) -> None:
        def fail(message: str, hint: str) -> LoadError:
            return LoadError([document.diagnostic(element, "TG220", message, hint, attribute="path")])

        given = element.attributes.get("path")
        if given is None:
            raise fail("an <include> has no path", 'write <include path="file.xml"/>')
        if "ros_pkg" in element.attributes:
            base_path = _package_folder(element.attributes["ros_pkg"])
            if base_path is None:
                raise fail(f"the ROS package '{element.attributes['ros_pkg']}' is not installed here", "")
        if base_path is None:
            raise fail(
                f"'{given}' cannot be found from here", "load the document from a file, or give base_path"
            )
        path = (base_path / given).resolve()
        if path in above:
            raise fail(f"'{given}' includes itself", "remove one of the <include>s")
        try:
            data = path.read_bytes()
        except OSError as error:
            raise fail(
                f"'{path}' cannot be read: {error.strerror}", "paths are relative to the file"
            ) from None
        self._read(data, str(path), path.parent, [*above, path])

    def check(self, registry: Mapping[str, NodeType]) -> list[Diagnostic]:
        """Checks the structure of all documents and collects their trees."""
        problems = []
        before: dict[str, Definition] = {}
        for index, document in enumerate(self.documents):
            if index == self._main_from:
                before = {tree: found for tree, found in self.definitions.items() if found.has_id}
            check = StructureCheck(document, registry)
            check.run()
            problems += check.problems
            self.definitions.update(check.definitions)
            self.models.update(check.models)
        self._new = [found for tree, found in self.definitions.items() if tree not in before]
        return problems

    def main_tree(self, wanted: str | None) -> Definition:
        """Returns the tree to run.

        It is the given one; that of ``main_tree_to_execute``; the only one of the document, or of it and its
        includes; that which the first document names; or the only one of all.

        Raises:
            LoadError: no tree is named and there are several, or the named tree does not exist.
        """
        assert self.main is not None
        assert self._first is not None
        named: str | None = wanted or self.main.root.attributes.get("main_tree_to_execute")
        if named is None:
            own = [element for element in self.main.root.children if element.tag == "BehaviorTree"]
            named = own[0].attributes.get("ID") if len(own) == 1 else None
        if not named and len(self._new) == 1 and (self._new[0].tree_id or not self._new[0].has_id):
            return self._new[0]
        if not named:
            only = next(iter(self.definitions)) if len(self.definitions) == 1 else None
            named = self._first.root.attributes.get("main_tree_to_execute", only)
        if named is not None and named in self.definitions:
            return self.definitions[named]
        known = ", ".join(tree for tree in self.definitions if tree) or "none"
        message = "no main tree is named" if named is None else f"there is no tree '{named}'"
        hint = f'write main_tree_to_execute="…" at the root; the trees are: {known}'
        raise LoadError(
            [self.main.diagnostic(self.main.root, "TG221", message, hint, attribute="main_tree_to_execute")]
        )

    def check_cycles(self, main: Definition) -> list[Diagnostic]:
        """Finds trees that contain themselves, and SubTrees whose tree does not exist, from `main` on."""
        problems: list[Diagnostic] = []
        done: set[str] = set()
        above: dict[str, None] = {main.tree_id: None}  # in order, and quick to look up
        stack = [(main, iter(main.subtrees))]
        while stack:
            definition, rest = stack[-1]
            element = next(rest, None)
            if element is None:
                stack.pop()
                done.add(above.popitem()[0])
                continue
            name = element.attributes["ID"]
            target = self.definitions.get(name)
            report = definition.document.diagnostic
            if target is None:
                known = ", ".join(tree for tree in self.definitions if tree) or "none"
                message, hint = f"there is no tree '{name}'", f"the trees are: {known}"
                problems.append(
                    report(element, "TG222", message, hint, attribute="ID", tree=definition.tree_id)
                )
            elif name in above:
                names = list(above)
                way = " → ".join([*names[names.index(name) :], name])
                hint = "use Repeat or KeepRunningUntilFailure to do something again"
                message = f"the tree '{name}' contains itself: {way}"
                problems.append(
                    report(element, "TG223", message, hint, attribute="ID", tree=definition.tree_id)
                )
            elif name not in done:
                above[name] = None
                stack.append((target, iter(target.subtrees)))
        return problems


def _package_folder(package: str) -> pathlib.Path | None:
    try:
        from ament_index_python.packages import get_package_share_directory  # noqa: PLC0415 - only where ROS is

        return pathlib.Path(get_package_share_directory(package))
    except (ImportError, LookupError, ValueError, OSError):
        return None
