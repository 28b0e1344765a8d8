"""Keys that are read before anyone can have written them."""

from __future__ import annotations

import pytest

from tests.budget import count
from tests.translator.check.finding import LEAF, find, findings
from tests.translator.check.results.engine import case_project, places_of
from translator.check.context import Context
from translator.check.order import check_order

READS = {"type": "Script", "ports": {"code": "y := x + 1"}}
WRITES = {"type": "Script", "ports": {"code": "x := 1"}}
TESTS = {"type": "ScriptCondition", "ports": {"code": "z"}}


def tree(type_, *children, **ports):
    rows = {
        "n1": {"type": type_, "children": [f"c{index}" for index in range(len(children))], "ports": ports}
    }
    for index, child in enumerate(children):
        rows.update(child(f"c{index}") if callable(child) else {f"c{index}": child})
    return rows


def under(type_, *children, **ports):
    """A branch: a function that makes its nodes below a given id."""

    def rows(name):
        found = {
            name: {"type": type_, "ports": ports, "children": [f"{name}_{n}" for n in range(len(children))]}
        }
        for index, child in enumerate(children):
            key = f"{name}_{index}"
            found.update(child(key) if callable(child) else {key: child})
        return found

    return rows


@pytest.mark.parametrize(
    ("nodes", "reader"),
    [
        (tree("Sequence", READS, WRITES), "c0"),
        (tree("ReactiveSequence", READS, LEAF, WRITES), "c0"),
        (tree("Fallback", under("ForceFailure", READS), WRITES), "c0_0"),
        (tree("Sequence", LEAF, under("Sequence", LEAF, READS), WRITES), "c1_1"),
        (tree("Parallel", READS, WRITES), "c0"),
        (tree("ParallelAll", LEAF, READS, WRITES), "c1"),
        (tree("Parallel", LEAF, READS, WRITES), "c1"),
        (tree("IfThenElse", {"type": "ScriptCondition", "ports": {"code": "x"}}, WRITES), "c0"),
        (tree("TryCatch", READS, WRITES), "c0"),
        (tree("Sequence", under("Repeat", READS, num_cycles="3"), WRITES), "c0_0"),
        (
            tree(
                "Sequence",
                {"type": "Act", "ports": {"speed": "{x}"}},
                {"type": "Act", "ports": {"result": "{x}"}},
            ),
            "c0",
        ),
        (tree("Sequence", {**LEAF, "conditions": {"_skipIf": "x"}}, WRITES), "c0"),
        (tree("Sequence", {"type": "Script", "ports": {"code": "y := @x"}}, WRITES), "c0"),
    ],
)
def test_found(make_project, nodes, reader):
    found = find(check_order, make_project(nodes), "BT0405")
    assert found.place.node == reader
    assert [(step.role, step.what) for step in found.path] == [("reads", "x"), ("writes", "x")]


@pytest.mark.parametrize(
    "nodes",
    [
        tree("Sequence", WRITES, READS),
        tree("Sequence", under("Fallback", TESTS, READS), WRITES),  # it may be read later, after the write
        tree("Sequence", {**READS, "conditions": {"_skipIf": "z"}}, WRITES),
        tree("IfThenElse", TESTS, READS, WRITES),
        tree("Switch2", READS, WRITES, LEAF, variable="{v}", case_1="1", case_2="2"),
        tree("Sequence", under("Precondition", READS, **{"if": "z"}), WRITES),
        tree("Sequence", {"type": "WasEntryUpdated", "ports": {"entry": "{x}"}}, WRITES),
        tree("Sequence", {"type": "Script", "ports": {"code": "x := 1; y := x"}}, WRITES),
        tree("Sequence", {"type": "Act", "ports": {"counter": "{x}"}}, WRITES),
        tree("Sequence", {**READS, "disabled": True}, WRITES),
        tree("Sequence", {**LEAF, "conditions": {"_onSuccess": "y := x"}}, WRITES),
        tree("Sequence", {"type": "Open", "ports": {"some": "{x}"}}, WRITES),
        tree("Sequence", READS),  # nobody writes it: BT0401
    ],
)
def test_not_found(make_project, nodes):
    assert findings(check_order, make_project(nodes)) == []


CALL = {"type": "SubTree", "tree": "Other", "ports": {"inner": "{x}"}}
INNER = {"type": "Script", "ports": {"code": "y := inner"}}


def test_a_called_tree_reads_under_the_names_of_its_caller(make_project):
    other = {"n1": {"type": "Sequence", "children": ["a", "b"]}, "a": LEAF, "b": INNER}
    found = find(check_order, make_project(tree("Sequence", CALL, WRITES), trees={"Other": other}), "BT0405")
    assert (found.place.tree, found.place.node) == ("MainTree", "c0")
    assert [(step.tree, step.node, step.role, step.what) for step in found.path] == [
        ("MainTree", "c0", "", ""),
        ("Other", "b", "reads", "inner"),
        ("MainTree", "c1", "writes", "x"),
    ]
    fine = make_project(tree("Sequence", WRITES, CALL), trees={"Other": other})
    assert findings(check_order, fine) == []


def test_a_read_that_the_called_tree_may_leave_out_is_not_early(make_project):
    other = {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": TESTS, "b": INNER}
    assert findings(check_order, make_project(tree("Sequence", CALL, WRITES), trees={"Other": other})) == []


def test_a_key_of_a_called_tree_alone_is_looked_at_there(make_project):
    other = tree("Sequence", READS, WRITES)
    alone = make_project({"n1": {"type": "SubTree", "tree": "Other"}}, trees={"Other": other})
    found = find(check_order, alone, "BT0405")
    assert (found.place.tree, found.place.node) == ("Other", "c0")
    shared = {"n1": {"type": "SubTree", "tree": "Other", "ports": {"x": "{x}"}}}
    found = find(check_order, make_project(shared, trees={"Other": other}), "BT0405")
    assert (found.place.tree, found.place.node) == ("MainTree", "n1")
    given = {"n1": {"type": "SubTree", "tree": "Other", "ports": {"x": "1"}}}
    assert findings(check_order, make_project(given, trees={"Other": other})) == []


def test_what_is_found_is_so_in_the_engine():
    found = 0
    for seed in range(1, 3 * count("checker_soundness") + 1):
        project, log, engine = case_project(seed)
        context = Context(project)
        check_order(context)
        early = [item for item in context.found if item.path[-1].role == "writes"]
        places = places_of(project, engine)
        ticked: dict[tuple[str, str], int] = {}
        for number, (uid, _status) in enumerate(log):
            if not engine.nodes[uid - 1].children:
                ticked.setdefault(places[uid], number)
        for item in early:
            key = item.values["key"]
            keys = context.keys[item.place.tree]
            writers = {node for node, part in keys.parts.items() if key in part.written}
            reads = ticked.get((item.place.tree, item.place.node))
            writes = [ticked[item.place.tree, node] for node in writers if (item.place.tree, node) in ticked]
            assert reads is None or not writes or reads < min(writes), (seed, str(item))
            found += reads is not None and bool(writes)
    assert found
