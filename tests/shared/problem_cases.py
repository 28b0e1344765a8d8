"""Projects written by hand, for `make_problems`: shapes, subtrees, names, scripts, reachability."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

Trees = dict[str, dict[str, Any]]

LEAF = {"type": "AlwaysSuccess"}
NAMES = (
    "name",
    "ID",
    "_own",
    "1st",
    "a b",
    "a-b",
    "-a",
    "a.b",
    "a:b",
    "é",
    "日本",
    "",
    "a<b",
    "speed",
    "_autoremap",
)
SCRIPTS = ("", "  ", "x := 1", "x :=", "{key}", " {=} ", "{}", "{key", "x == {key}", "1 2", "'open")
AUTOREMAP = ("", "0", "1", "true", "True", "TRUE", "tRue", "false", "yes", "maybe")
PORTS = [
    {"name": "double", "type": "double"},
    {"name": "int", "type": "int"},
    {"name": "out", "direction": "output", "type": "double"},
    {"name": "free"},
    {"name": "given", "type": "int", "default": "3"},
]
VALUES = ("", "5", "-5", "+5", " 5", "5.0", "2.5", "12abc", "fast", "{key}")


def tree(nodes: dict[str, dict[str, Any]], root: str | None = "r", **more: Any) -> dict[str, Any]:
    """A tree from its nodes."""
    return {"root": root, "nodes": nodes, **more}


def row(nodes: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    """A tree of a Sequence with these nodes."""
    children = [f"n{index}" for index in range(len(nodes))]
    below = dict(zip(children, nodes, strict=True))
    return tree({"r": {"type": "Sequence", "children": children}, **below}, **more)


def call(target: str, **more: Any) -> dict[str, Any]:
    """A SubTree node."""
    return {"type": "SubTree", "tree": target, **more}


def written_cases(keys: tuple[str, ...]) -> Iterator[tuple[str, Trees]]:
    """Yields the name of each case and the trees of its project."""
    yield from _shapes()
    yield from _subtrees(keys)
    yield from _names_and_scripts()
    yield from _reached()


def _shapes() -> Iterator[tuple[str, Trees]]:
    yield "nothing", {"MainTree": tree({}, root=None)}
    yield "only a draft", {"MainTree": tree({"d": LEAF}, root=None, drafts=["d"])}
    wrong = {"type": "Inverter", "ports": {"no": "{"}, "conditions": {"_skipIf": ""}}
    yield "a wrong draft", {"MainTree": tree({"r": LEAF, "d": wrong, "e": LEAF}, drafts=["d", "e"])}
    yield "a loose piece that nobody lists", {"MainTree": tree({"r": LEAF, "d": LEAF})}
    yield "a leaf with a child", {"MainTree": tree({"r": {"type": "Open", "children": ["a"]}, "a": LEAF})}
    unknown = {"type": "Nope", "ports": {"a": "{"}, "conditions": {"_while": "x =="}}
    yield "an unknown leaf", {"MainTree": row([unknown, LEAF])}
    yield "an unknown control node", {"MainTree": tree({"r": {"type": "Nope", "children": ["a"]}, "a": LEAF})}
    yield "a tree as a node", {"MainTree": row([{"type": "Other"}]), "Other": tree({"r": LEAF})}
    waiting = {"type": "AsyncSequence", "children": ["c"]}
    top = {"type": "ReactiveSequence", "children": ["a", "b"]}
    nodes: dict[str, dict[str, Any]] = {"r": top, "a": waiting, "c": LEAF, "d": LEAF}
    yield "two AsyncSequences", {"MainTree": tree({**nodes, "b": {**waiting, "children": ["d"]}})}
    yield "one AsyncSequence", {"MainTree": tree({**nodes, "b": LEAF, "d": LEAF})}
    nodes["r"] = {"type": "Sequence", "children": ["a", "b"]}
    yield "two AsyncSequences elsewhere", {"MainTree": tree({**nodes, "b": {**waiting, "children": ["d"]}})}
    yield "disabled", {"MainTree": row([{"type": "Required", "disabled": True}])}
    yield "defaults", {"MainTree": row([{"type": "Required"}, {"type": "Default"}])}


def _subtrees(keys: tuple[str, ...]) -> Iterator[tuple[str, Trees]]:
    inner = {"Inner": tree({"r": LEAF}, ports=PORTS)}
    yield "a tree that is not there", {"MainTree": row([call("Nope"), call(""), {"type": "SubTree"}])}
    yield "a tree in itself", {"MainTree": row([call("MainTree")])}
    yield "two trees in a ring", {"MainTree": row([call("B")]), "B": row([LEAF, call("MainTree")])}
    yield (
        "a ring of others",
        {
            "MainTree": row([call("A")]),
            "A": row([call("B")]),
            "B": row([call("A"), LEAF]),
        },
    )
    yield (
        "a ring over a draft",
        {
            "MainTree": row([call("B")]),
            "B": tree({"r": LEAF, "d": call("MainTree")}, drafts=["d"]),
        },
    )
    twice = [call("A"), call("A")]
    yield "two rings that share a tree", {"MainTree": row([call("A")]), "A": row(twice), "B": row(twice)}
    both = [call("B"), call("MainTree"), call("Loose")]
    yield "rings through the main tree", {"MainTree": row(twice), "A": row(both), "B": row(both)}
    loose = {"Y": row([call("Z")]), "Z": row([call("Y")])}
    yield "a ring that nothing calls", {"MainTree": row([LEAF]), **loose}
    yield (
        "one name for two calls",
        {
            "MainTree": row([call("Inner", name="x"), call("Inner", name="x"), call("Inner"), call("Inner")]),
            "Inner": tree({"r": LEAF}),
        },
    )
    yield "ports of a tree, none given", {"MainTree": row([call("Inner")]), **inner}
    for autoremap in AUTOREMAP:
        node = call("Inner", attributes={"_autoremap": autoremap})
        yield f"_autoremap is {autoremap!r}", {"MainTree": row([node]), **inner}
    yield (
        "_autoremap among the ports",
        {
            "MainTree": row([call("Inner", ports={"_autoremap": "yes"})]),
            **inner,
        },
    )
    for port in PORTS:
        given = [call("One", ports={port["name"]: text}) for text in (*VALUES, *keys)]
        one = {"One": tree({"r": LEAF}, ports=[port])}
        yield f"values of a tree's port {port['name']}", {"MainTree": row(given), **one}
    free = [call("Inner", ports={"x": text}) for text in keys]
    yield "any port of a tree", {"MainTree": row(free), "Inner": tree({"r": LEAF})}
    yield (
        "names of a tree's ports",
        {
            "MainTree": row([call("Inner", ports={name: "1"}) for name in NAMES]),
            **inner,
        },
    )


def _names_and_scripts() -> Iterator[tuple[str, Trees]]:
    yield (
        "names of ports of an open action",
        {"MainTree": row([{"type": "Open", "ports": {name: "{"}} for name in NAMES])},
    )
    yield (
        "names of ports of a closed action",
        {"MainTree": row([{"type": "Required", "ports": {name: "{"}} for name in NAMES])},
    )
    yield (
        "keys of an open action",
        {"MainTree": row([{"type": "Open", "ports": {"p": text}} for text in ("{", "{}", "{a}{b}", "{x}")])},
    )
    yield "scripts", {"MainTree": row([{"type": "Script", "ports": {"code": text}} for text in SCRIPTS])}
    for type_ in ("ScriptCondition", "Precondition"):
        port = "code" if type_ == "ScriptCondition" else "if"
        below = {"children": ["c"]} if type_ == "Precondition" else {}
        for text in ("", "  ", "1"):
            top: dict[str, Any] = {"type": type_, "ports": {port: text}, **below}
            nodes = {"r": top, **({"c": LEAF} if below else {})}
            yield f"{type_} of {text!r}", {"MainTree": tree(nodes)}
    yield "conditions", {"MainTree": row([{**LEAF, "conditions": {"_skipIf": text}} for text in SCRIPTS])}


def _reached() -> Iterator[tuple[str, Trees]]:
    wrong = row([{"type": "Required"}, {"type": "Script", "ports": {"code": "x :="}}, {"type": "Inverter"}])
    yield "a wrong tree that nothing calls", {"MainTree": row([LEAF]), "Loose": wrong}
    yield "a wrong tree that is called", {"MainTree": row([call("Loose")]), "Loose": wrong}
    yield "an empty tree that nothing calls", {"MainTree": row([LEAF]), "Loose": tree({}, root=None)}
    yield "an empty tree that is called", {"MainTree": row([call("Loose")]), "Loose": tree({}, root=None)}
    yield "no main tree", {"Loose": wrong, "Other": row([LEAF])}
