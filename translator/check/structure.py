"""Checks of the structure of trees: known nodes, numbers of children, names, roots, drafts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from translator.catalog import NodeModel, did_you_mean, nearest
from translator.diagnostic import Place, diagnostic
from translator.limits import LEVELS_PER_TREE
from translator.settings import NO_UNIVERSE, PROJECT_FILE
from translator.text import bad_character, is_valid_id
from translator.xml.attributes import is_free

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.tree import Node, Tree


def check_structure(context: Context) -> None:
    """Reports every reason why a tree cannot be built."""
    _check_universes(context)
    _check_main(context)
    for tree in context.project.trees.values():
        _check_tree(context, tree)
        names: dict[str, Node] = {}
        for node in tree.walk():
            _check_node(context, tree, node)
            if node.name and not node.is_subtree:
                if node.name in names:
                    context.report("BT0108", tree, node, name=node.name, other=names[node.name].id)
                names.setdefault(node.name, node)


def _check_universes(context: Context) -> None:
    """Reports a universe that cannot be chosen, since its name means *no world*."""
    if (file := f"universes/{NO_UNIVERSE}.yaml") in context.project.files:
        context.found.append(diagnostic("BT0031", Place(file, line=1), name=NO_UNIVERSE, file=file))


def _check_main(context: Context) -> None:
    project = context.project
    main = project.settings.main_tree
    if main not in project.trees:
        hint = did_you_mean(main, project.trees, otherwise="Choose the main tree in the project's settings.")
        place = Place(PROJECT_FILE, line=1)
        near = nearest(main, project.trees)
        context.found.append(diagnostic("BT0100", place, main=main, suggestion=hint, near=near))
        return
    for tree_id, tree in project.trees.items():
        if tree_id not in context.reachable and tree.root is not None:
            context.report("BT0109", tree, tree=tree_id)


def _check_tree(context: Context, tree: Tree) -> None:
    if not is_valid_id(tree.id):
        context.report("BT0107", tree, name=tree.id, character=bad_character(tree.id) or tree.id)
    if context.project.model(tree.id) is not None:
        context.report("BT0110", tree, name=tree.id)
    if tree.root is None:
        context.report("BT0101" if tree.id in context.reachable else "BT0115", tree, tree=tree.id)
    elif (depth := tree.depth()) > LEVELS_PER_TREE:
        context.report("BT0106", tree, tree.nodes[tree.root], depth=depth, limit=LEVELS_PER_TREE)
    for draft in tree.drafts:
        context.report("BT0103", tree, tree.nodes.get(draft), type=tree.nodes[draft].type)


def _check_node(context: Context, tree: Tree, node: Node) -> None:
    model = context.model(node.type)
    if model is None:
        _report_unknown(context, tree, node)
        return
    count = len(node.children)
    if count < model.min_children or (model.max_children is not None and count > model.max_children):
        context.report(
            "BT0104",
            tree,
            node,
            type=node.type,
            wanted=_wanted(model),
            count=count,
            advice=_advice(model, count),
        )
    for name in node.attributes:
        if not is_free(name):
            context.report("BT0211", tree, node, attribute=name)
    if node.disabled:
        context.report("BT0105", tree, node, type=node.label)
    if node.type == "ReactiveSequence":
        _check_async_children(context, tree, node)


def _report_unknown(context: Context, tree: Tree, node: Node) -> None:
    if node.type in context.project.trees:
        context.report("BT0111", tree, node, type=node.type)
    elif node.children:
        known = context.project.known_types()
        with_children = [name for name in known if (model := context.model(name)) and model.max_children != 0]
        base = "ControlNode" if len(node.children) > 1 else "DecoratorNode"
        otherwise = (
            f"Write actions/{node.type}.py with a class {node.type} derived from tree_gardener.{base}."
        )
        suggestion = did_you_mean(node.type, with_children, otherwise=otherwise)
        context.report("BT0112", tree, node, type=node.type, suggestion=suggestion)
    else:
        otherwise = f"Write actions/{node.type}.py with a class {node.type}."
        suggestion = did_you_mean(node.type, context.project.known_types(), otherwise=otherwise)
        context.report("BT0102", tree, node, type=node.type, suggestion=suggestion)


def _check_async_children(context: Context, tree: Tree, node: Node) -> None:
    waiting = [child for child in node.children if tree.nodes[child].type == "AsyncSequence"]
    if len(waiting) > 1:
        context.report("BT0113", tree, tree.nodes[waiting[1]])


def _wanted(model: NodeModel) -> str:
    low, high = model.min_children, model.max_children
    if high == 0:
        return "no children"
    if high is None:
        return f"at least {low} child" + ("ren" if low != 1 else "")
    if low == high:
        return f"exactly {low} child" + ("ren" if low != 1 else "")
    return f"{low} to {high} children"


def _advice(model: NodeModel, count: int) -> str:
    if model.max_children == 0:
        return "Hang the children below a control node."
    if model.max_children is not None and count > model.max_children:
        return "Put a control node such as a Sequence between." if model.max_children == 1 else "Remove some."
    return "Connect what is missing, or remove the node."
