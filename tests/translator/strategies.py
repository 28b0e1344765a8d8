"""Random trees: well formed, of built-in nodes and two actions, with all that a node can carry."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import strategies as st

from translator.catalog import builtins
from translator.tree import Node, Tree

KEYS = ("a", "speed", "goal")
# Nodes that both engines load with any children: without ports, or with default values.
CONTROLS = (
    "Sequence",
    "Fallback",
    "ReactiveFallback",
    "SequenceWithMemory",
    "AsyncFallback",
    "Parallel",
    "ParallelAll",
)
DECORATORS = ("Inverter", "ForceSuccess", "ForceFailure", "KeepRunningUntilFailure", "RunOnce")
LEAVES = ("AlwaysSuccess", "AlwaysFailure")
COUNTED = {
    "Repeat": "num_cycles",
    "RetryUntilSuccessful": "num_attempts",
    "Delay": "delay_msec",
    "Timeout": "msec",
}

text = st.text(
    st.characters(
        exclude_categories=("Cs", "Cc"), include_characters="\n\t", exclude_characters="\ufffe\uffff"
    ),
    max_size=12,
)
names = st.one_of(st.just(""), text.filter(lambda value: value.strip() == value))
numbers = st.integers(-5000, 5000) | st.floats(-1e6, 1e6, allow_nan=False).map(lambda value: round(value, 3))
scripts = st.sampled_from(["a := 1", "true", "a == 1 && true", "speed > 0.5", "'x' == 'y'"])
conditions = st.dictionaries(
    st.sampled_from(["_skipIf", "_successIf", "_failureIf", "_while", "_onSuccess", "_onHalted", "_post"]),
    scripts,
    max_size=2,
)


@st.composite
def nodes(draw, node_id, type_, children=(), *, plain=False):
    """One node of a type, with random properties."""
    ports = {}
    if type_ in COUNTED:
        ports[COUNTED[type_]] = str(draw(st.integers(0, 5)))
    elif type_ == "Script":
        ports["code"] = draw(scripts)
    elif type_ == "Open":
        ports = draw(st.dictionaries(st.sampled_from(["p", "q", "größe"]), text, max_size=2))
    node = Node(node_id, type_, children=tuple(children), ports=ports)
    if plain:
        return node
    return replace(
        node,
        name=draw(names),
        conditions=draw(conditions),
        comment=draw(text),
        color=draw(st.sampled_from(["", "#9c27b0"])),
        position=draw(st.none() | st.tuples(numbers, numbers)),
        disabled=draw(st.booleans()),
        collapsed=draw(st.booleans()),
        silenced=draw(st.dictionaries(st.sampled_from(["BT0119", "BT0402", "?"]), text, max_size=2)),
        attributes=draw(st.dictionaries(st.sampled_from(["_mine", "_uid"]), text, max_size=1)),
    )


@st.composite
def trees(draw, *, tree_id="MainTree", leaves=(*LEAVES, "Script", "Open"), plain=False, largest=25):
    """Returns a tree whose nodes have valid numbers of children."""
    budget = draw(st.integers(1, largest))
    made: dict[str, Node] = {}
    count = 0

    def grow(depth):
        nonlocal count
        count += 1
        node_id = f"n{count}"
        kind = (
            draw(st.sampled_from(["leaf", "control", "decorator"]))
            if count < budget and depth < 12
            else "leaf"
        )
        made[node_id] = Node(node_id, "")  # keeps the ids in the order of the tree
        if kind == "control":
            children = [grow(depth + 1) for _ in range(draw(st.integers(1, 4)))]
            type_ = draw(st.sampled_from(CONTROLS))
        elif kind == "decorator":
            children, type_ = [grow(depth + 1)], draw(st.sampled_from([*DECORATORS, *COUNTED]))
        else:
            children, type_ = [], draw(st.sampled_from(leaves))
        made[node_id] = draw(nodes(node_id, type_, children, plain=plain))
        return node_id

    root = grow(1)
    assert all(node.type in builtins() or node.type == "Open" for node in made.values())
    return Tree(tree_id, root, made)


def without_braces(tree: Tree) -> Tree:
    """Returns a tree whose ports hold no braces: a brace without its partner is refused before a run."""
    brackets = str.maketrans("{}", "()")
    made = {
        key: replace(node, ports={port: text.translate(brackets) for port, text in node.ports.items()})
        for key, node in tree.nodes.items()
    }
    return replace(tree, nodes=made)
