"""Writes `problems.json`: the translator's findings in projects, which the editor's check must match.

python -m tests.shared.make_problems
"""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tests.shared.problem_cases import LEAF, written_cases
from translator import check, load
from translator.catalog import builtins
from translator.diagram import restore_document
from translator.project import action_node_model

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.catalog import NodeModel
    from translator.project import Project

HERE: Final = Path(__file__).parent
FILE: Final = HERE / "problems.json"
KINDS: Final = HERE.parents[1] / "frontend/src/model/kinds.json"
Nodes = dict[str, dict[str, Any]]
Trees = dict[str, dict[str, Any]]

TYPES: Final = {
    "int": "int",
    "double": "float",
    "bool": "bool",
    "string": "str",
    "any": "None",
    "list_int": "'list[int]'",
    "list_double": "'list[float]'",
    "list_bool": "'list[bool]'",
    "list_string": "'list[str]'",
}
DIRECTIONS: Final = ("input", "output", "inout")
KEYS: Final = (
    *(
        "{}",
        "{ }",
        " {} ",
        "{=}",
        "{key}",
        " {key} ",
        "\t{key}\n",
        "\u00a0{key}",
        "{ key }",
        "{@key}",
        "{@@key}",
    ),
    *("{k@y}", "{a}{b}", "{{a}}", "{a", "a}", "{", "}", "a{b", "a{b}c", "}a{", "${key}", '{"a": 1}', "{a:b}"),
)
LITERALS: Final = (
    *("", " ", "0", "1", "-1", "+1", " 5", "5 ", "12abc", "5.7", "0x10", "2147483647", "2147483648"),
    *("-2147483648", "-2147483649", "4294967295", "4294967296", "99999999999999999999999", "\u0663", "1,5"),
    *(
        "1.5",
        ".5",
        "5.",
        "-",
        ".",
        "1e3",
        "1e",
        "-2.5e-3",
        "inf",
        "-Infinity",
        "nan",
        "\u0131nf",
        "fast",
        "1.5m",
        "1e400",
        "-1e400x",
        "1e-400",
        "0e-400",
        "1.e999",
    ),
    *("true", "TRUE", "True", "tRue", "false", "yes", "SUCCESS", "success", "IDLE", "RUNNING!"),
    *(
        "1;2;3",
        "1; 2",
        "1;",
        ";",
        "1;x",
        "1.5;2",
        "a;b",
        "true;0",
        "json:[1,2]",
        "json:[1",
        "json:{}",
        "json:NaN",
        "1;99999999999",
        "1;1e999",
    ),
)
FEW: Final = ("", "7", "-7", "2.5", "word", "{key}", "{", "{}", "true", "FAILURE", "1;2")


def action_source(name: str, direction: str, type_: str) -> str:
    """An action with one port."""
    ports = f"    {direction.upper()}_PORTS = {{'p': Port({type_})}}\n"
    return (
        "import py_trees\nfrom tree_gardener.ports import Port\n\n\n"
        f"class {name}(py_trees.behaviour.Behaviour):\n{ports}"
        "    def update(self):\n        return py_trees.common.Status.SUCCESS\n"
    )


def own_source(name: str, base: str, children: str = "") -> str:
    """Returns the source of a control node or decorator of the project."""
    return (
        f"from tree_gardener import {base}\n\n\nclass {name}({base}):\n{children}"
        "    INPUT_PORTS = {}\n\n    def update(self):\n        return self.tick_child(0)\n"
    )


ACTIONS: Final = {
    **{
        f"{d}_{name}": action_source(f"{d}_{name}", d, type_)
        for d in DIRECTIONS
        for name, type_ in TYPES.items()
    },
    "Required": action_source("Required", "input", "float, required=True"),
    "Default": action_source("Default", "input", "float, required=True, default=1.5"),
    "Own": own_source("Own", "ControlNode", "    MIN_CHILDREN = 2\n    MAX_CHILDREN = 3\n"),
    "AnyNumber": own_source("AnyNumber", "ControlNode"),
    "Around": own_source("Around", "DecoratorNode"),
    "EachInt": "from tree_gardener import LoopNode\n\n\nclass EachInt(LoopNode):\n    ELEMENT = int\n",
    "Open": "import py_trees\n\n\nclass Open(py_trees.behaviour.Behaviour):\n"
    "    def update(self):\n        return py_trees.common.Status.SUCCESS\n",
}


def project_of_actions() -> Project:
    """A project of all the actions, without a tree."""
    files = {f"actions/{name}.py": source.encode() for name, source in ACTIONS.items()}
    files["project.json"] = json.dumps({"format": "bt-studio/project", "version": 1, "name": "Test"}).encode()
    return load(files)


def judged(project: Project, trees: Trees, codes: set[str]) -> list[list[str]]:
    """Returns the translator's findings in a project of these trees: tree, node, port, code, severity."""
    read = []
    for tree_id, tree in trees.items():
        document = {"format": "bt-studio/diagram", "version": 1, "id": tree_id, **tree}
        found, _ = restore_document(document, file=f"trees/{tree_id}.json")
        read += [found] if found is not None else []
    placed = {tree.id: tree for tree in read}
    return sorted(
        [item.place.tree, item.place.node, item.place.port, item.code, item.severity.value]
        for item in check(replace(project, trees=placed))
        if item.code in codes
    )


def in_a_row(nodes: list[tuple[str, dict[str, Any]]]) -> Trees:
    """Returns one tree with the nodes, each with the children that it needs, under one Sequence."""
    rows: Nodes = {"r": {"type": "Sequence", "children": [f"n{index}" for index in range(len(nodes))]}}
    for index, (type_, ports) in enumerate(nodes):
        model = builtins().get(type_)
        leaves = [f"n{index}_{number}" for number in range(model.min_children if model else 0)]
        rows[f"n{index}"] = {"type": type_, "ports": ports, **({"children": leaves} if leaves else {})}
        rows.update({leaf: {"type": "AlwaysSuccess"} for leaf in leaves})
    return {"MainTree": {"root": "r", "nodes": rows}}


def counts_of(model: NodeModel) -> Iterator[tuple[str, Trees]]:
    """Returns trees with a kind of node without ports, with no child up to one too many."""
    most = model.max_children if model.max_children is not None else model.min_children + 1
    for count in range(most + 2):
        children = [f"c{number}" for number in range(count)]
        nodes: Nodes = {"r": {"type": model.type, **({"children": children} if children else {})}}
        nodes.update({child: {"type": "AlwaysSuccess"} for child in children})
        yield f"{model.type} with {count} children", {"MainTree": {"root": "r", "nodes": nodes}}


def cases() -> Iterator[tuple[str, Trees]]:
    """Yields the name of each case and the trees of its project."""
    for model in builtins().values():
        yield from counts_of(model)
        for port in model.ports:
            others = {name: "{=}" for name in model.ports if name != port}
            yield f"{model.type}.{port}", in_a_row([(model.type, {**others, port: text}) for text in FEW])
    project = project_of_actions()
    for name in ("Own", "AnyNumber", "Around"):
        yield from counts_of(action_node_model(project.actions[name]))
    for queue in ("1;2", "1;x", "{q}", "", "{"):
        loop = {"type": "EachInt", "ports": {"queue": queue, "value": "{v}"}, "children": ["c"]}
        yield (
            f"an own loop over {queue!r}",
            {"MainTree": {"root": "r", "nodes": {"r": loop, "c": dict(LEAF)}}},
        )
    for direction in DIRECTIONS:
        for type_ in TYPES:
            texts = KEYS + LITERALS if direction == "input" else KEYS[:6] + LITERALS[:16]
            name = f"{direction}_{type_}"
            yield name, in_a_row([(name, {"p": text}) for text in texts])
    pairs = [(first, second) for first in TYPES for second in TYPES]
    keyed = [
        (f"input_{type_}", {"p": f"{{k{number}}}"}) for number, pair in enumerate(pairs) for type_ in pair
    ]
    yield "one entry in ports of two types", in_a_row(keyed)
    yield from written_cases(KEYS)


def document() -> dict[str, Any]:
    """The actions that all projects have, as the editor receives them, and every case.

    Listed are the findings that the editor makes too; its table names them.
    """
    codes = {code for known in json.loads(KINDS.read_text(encoding="utf-8")).values() for code in known}
    project = project_of_actions()
    rows = [{"what": what, "trees": trees, "found": judged(project, trees, codes)} for what, trees in cases()]
    actions = [
        {
            "name": action.name,
            "kind": action.kind,
            "children": {"min": action.min_children, "max": action.max_children},
            "open": action.open,
            "ports": [asdict(port) for port in action.ports],
        }
        for action in project.actions.values()
    ]
    return {"actions": actions, "cases": rows}


def text() -> str:
    """The file: a line for each action and each case."""
    whole = document()
    parts = [f'"{key}": [\n' + ",\n".join(_dump(row) for row in whole[key]) + "\n]" for key in whole]
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _dump(row: dict[str, Any]) -> str:
    return json.dumps(row, ensure_ascii=False, separators=(",", ":"))


def main() -> None:
    """Writes the file."""
    FILE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
