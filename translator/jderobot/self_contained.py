"""Reads and writes the self-contained XML of JdeRobot's BT Studio of 2024.

`<Root name="Tree Root"><BehaviorTree>…</BehaviorTree><Code><Forward>source</Forward>…</Code></Root>`;
subtrees are written in place, since that system joins all trees on one blackboard.
"""

from __future__ import annotations

import textwrap
from dataclasses import replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from translator.action import source_text
from translator.diagnostic import Diagnostic, Place, TranslatorError, diagnostic
from translator.diagram import diagram_path
from translator.export import require_sound, used_actions
from translator.importer import project_files
from translator.project import Project, load
from translator.settings import Settings
from translator.shared_modules import shared_modules
from translator.text import is_xml_name
from translator.xml.capital import ROOT, capital_root
from translator.xml.escape import attribute, character_data
from translator.xml.read import read_document
from translator.xml.source import parse_source

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.tree import Node, Tree


def is_old_form(raw: bytes | str) -> bool:
    """Returns whether a document has the form of 2024: `<Root>` with a tree without an ID, or with code."""
    attributes = capital_root(raw)
    if attributes is None or any(name in attributes for name in ("BTCPP_format", "main_tree_to_execute")):
        return False
    try:
        children = parse_source(raw, file="").root.children
    except TranslatorError:
        return True  # its reader says what is wrong
    is_named = any(child.tag == "BehaviorTree" and child.attributes.get("ID") for child in children)
    return not is_named or any(child.tag == "Code" for child in children)


def read_old_form(raw: bytes | str, *, file: str = "self_contained_tree.xml") -> Project:
    """Converts a document in the 2024 format to a project.

    Raises:
        TranslatorError: If the document cannot be read, or has no tree.
    """
    source = parse_source(raw, file=file)
    if source.root.tag != ROOT:
        place = Place(file, line=source.root.line, column=source.root.column)
        raise TranslatorError([diagnostic("BT0703", place, tag=source.root.tag)])
    data = source.data
    first = source.root
    # The rest of the document is plain v4: only the name of its root differs.
    opening = data[first.start : first.open_end]
    inner = data[first.open_end : first.end]
    closing = inner.rfind(b"</")
    renamed = data[: first.start] + b'<root BTCPP_format="4"' + opening[len(b"<Root") :]
    text = renamed + (inner[:closing] + b"</root>" if closing >= 0 else b"")
    document = read_document(text, file=file)
    found: list[Diagnostic] = list(document.diagnostics)
    if not document.trees:
        raise TranslatorError([*found, diagnostic("BT0734", Place(file, line=1, column=1))])
    tree = replace(document.trees[0].tree, attributes={})
    name = PurePosixPath(file).stem
    files = project_files(Settings(name=name, main_tree=tree.id, on_finish="repeat"), [tree])
    for action, code in document.code.items():
        files[f"actions/{action}.py"] = (textwrap.dedent(code).strip("\n") + "\n").encode()
    project = load(files)
    return replace(project, diagnostics=(*found, *project.diagnostics))


def write_old_form(project: Project) -> str:
    """Returns the project in the 2024 format.

    Raises:
        TranslatorError: If the project has errors, or uses what that system does not have.
    """
    require_sound(project)
    problems = list(_not_known_there(project))
    if problems:
        raise TranslatorError(problems)
    main = project.main
    assert main is not None  # noqa: S101 - a sound project has one
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', f'<{ROOT} name="Tree Root">', "  <BehaviorTree>"]
    lines.extend(_branch(project, main, main.root or "", 2))
    lines += ["  </BehaviorTree>", "  <Code>"]
    for action in used_actions(project):
        lines.append(f"    <{action.name}>{character_data(source_text(action.source))}</{action.name}>")
    return "\n".join([*lines, "  </Code>", f"</{ROOT}>", ""])


def _not_known_there(project: Project) -> Iterator[Diagnostic]:
    actions = [action.name for action in used_actions(project)]
    for module in shared_modules(project, actions):
        yield diagnostic("BT0810", Place(module.path, line=1), what="modules that actions share")
    for tree in project.trees.values():
        for node in tree.walk():
            place = Place(tree.file or diagram_path(tree.id), tree=tree.id, node=node.id)
            if node.conditions or node.disabled:
                yield diagnostic("BT0810", place, what="conditions and disabled nodes")
            elif node.is_subtree and (node.ports or not node.autoremap):
                yield diagnostic("BT0810", place, what="SubTrees with a blackboard of their own")
            elif not is_xml_name(node.type):
                yield diagnostic("BT0810", place, what=f"the name {node.type}")


def _branch(project: Project, tree: Tree, start: str, depth: int) -> Iterator[str]:
    stack: list[tuple[Tree, Node, int, bool]] = [(tree, tree.nodes[start], depth, False)]
    while stack:
        owner, node, level, is_closing = stack.pop()
        lead = "  " * level
        if is_closing:
            yield f"{lead}</{node.type}>"
        elif node.is_subtree:
            called = project.trees[node.tree]
            stack.append((called, called.nodes[called.root or ""], level, False))
        else:
            ports = "".join(f' {name}="{attribute(text)}"' for name, text in node.ports.items())
            opening = f'{lead}<{node.type} name="{attribute(node.name or node.type)}"{ports}'
            yield f"{opening}>" if node.children else f"{opening}/>"
            if node.children:
                stack.append((owner, node, level, True))
                stack.extend(
                    (owner, owner.nodes[child], level + 1, False) for child in reversed(node.children)
                )
