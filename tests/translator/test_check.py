"""Each check on the smallest project that violates it, and the place that it reports."""

from __future__ import annotations

import pytest

from translator import Severity, check, from_xml, load
from translator.diagnostic import rules

LEAF = {"type": "AlwaysSuccess"}


def find(project, code):
    found = [item for item in check(project) if item.code == code]
    assert found, f"{code} is not among {[str(item) for item in check(project)]}"
    return found[0]


def test_examples_have_nothing_to_say(example):
    assert check(example) == ()


CASES = {
    "unknown node": ("BT0102", {"n1": {"type": "Sequenze"}}, "n1"),
    "draft": ("BT0103", {"n1": LEAF, "n2": LEAF}, "n2"),
    "too few children": ("BT0104", {"n1": {"type": "Sequence"}}, "n1"),
    "too many children": (
        "BT0104",
        {"n1": {"type": "Inverter", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
        "n1",
    ),
    "leaf with a child": ("BT0104", {"n1": {"type": "Act", "children": ["a"]}, "a": LEAF}, "n1"),
    "disabled": ("BT0105", {"n1": {"type": "AlwaysSuccess", "disabled": True}}, "n1"),
    "same name": (
        "BT0108",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {**LEAF, "name": "x"},
            "b": {**LEAF, "name": "x"},
        },
        "b",
    ),
    "tree as node": ("BT0111", {"n1": {"type": "Other"}}, "n1"),
    "unknown control": ("BT0112", {"n1": {"type": "RoundRobin", "children": ["a"]}, "a": LEAF}, "n1"),
    "two async": (
        "BT0113",
        {
            "n1": {"type": "ReactiveSequence", "children": ["a", "b"]},
            "a": {"type": "AsyncSequence", "children": ["c"]},
            "b": {"type": "AsyncSequence", "children": ["d"]},
            "c": LEAF,
            "d": LEAF,
        },
        "b",
    ),
    "unreachable in a fallback": (
        "BT0114",
        {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": LEAF, "b": LEAF},
        "b",
    ),
    "unreachable in a sequence": (
        "BT0114",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {"type": "Inverter", "children": ["c"]},
            "c": LEAF,
            "b": LEAF,
        },
        "b",
    ),
    "else is unreachable": (
        "BT0114",
        {"n1": {"type": "IfThenElse", "children": ["a", "b", "c"]}, "a": LEAF, "b": LEAF, "c": LEAF},
        "c",
    ),
    "missing port": ("BT0201", {"n1": {"type": "Delay", "children": ["a"]}, "a": LEAF}, "n1"),
    "unknown port": ("BT0202", {"n1": {"type": "Act", "ports": {"sped": "1"}}}, "n1"),
    "brace open": ("BT0203", {"n1": {"type": "Act", "ports": {"speed": "{x"}}}, "n1"),
    "brace open on an open action": ("BT0203", {"n1": {"type": "Open", "ports": {"any": "{x"}}}, "n1"),
    "no number": ("BT0204", {"n1": {"type": "Act", "ports": {"speed": "fast"}}}, "n1"),
    "no integer": ("BT0204", {"n1": {"type": "Act", "ports": {"count": "many"}}}, "n1"),
    "integer too large": ("BT0212", {"n1": {"type": "Act", "ports": {"count": "99999999999"}}}, "n1"),
    "number too large": ("BT0212", {"n1": {"type": "Act", "ports": {"speed": "1e400"}}}, "n1"),
    "watching no entry": ("BT0201", {"n1": {"type": "WasEntryUpdated", "ports": {"entry": ""}}}, "n1"),
    "blank script": ("BT0301", {"n1": {"type": "Script", "ports": {"code": " "}}}, "n1"),
    "no condition": ("BT0301", {"n1": {"type": "ScriptCondition", "ports": {"code": ""}}}, "n1"),
    "script in an entry": ("BT0303", {"n1": {"type": "Script", "ports": {"code": "{k}"}}}, "n1"),
    "script beyond 64 bits": ("BT0304", {"n1": {"type": "Script", "ports": {"code": f"x := {2**63}"}}}, "n1"),
    "no boolean": ("BT0204", {"n1": {"type": "Act", "ports": {"flag": "perhaps"}}}, "n1"),
    "literal output": ("BT0205", {"n1": {"type": "Act", "ports": {"result": "5"}}}, "n1"),
    "read in part": ("BT0206", {"n1": {"type": "Act", "ports": {"count": "12abc"}}}, "n1"),
    "empty key": ("BT0207", {"n1": {"type": "Act", "ports": {"speed": "{}"}}}, "n1"),
    "bad key": ("BT0208", {"n1": {"type": "Act", "ports": {"speed": "{a}{b}"}}}, "n1"),
    "bad port name": ("BT0209", {"n1": {"type": "Open", "ports": {"1st": "x"}}}, "n1"),
    "two types": (
        "BT0210",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {"type": "Act", "ports": {"result": "{k}"}},
            "b": {"type": "Act", "ports": {"count": "{k}"}},
        },
        "b",
    ),
    "empty condition": ("BT0301", {"n1": {**LEAF, "conditions": {"_skipIf": " "}}}, "n1"),
    "bad script": ("BT0302", {"n1": {"type": "Script", "ports": {"code": "x := "}}}, "n1"),
    "bad condition": ("BT0302", {"n1": {**LEAF, "conditions": {"_skipIf": "x =="}}}, "n1"),
    "never written": ("BT0401", {"n1": {"type": "Act", "ports": {"speed": "{k}"}}}, "n1"),
    "name never written": ("BT0401", {"n1": {"type": "ScriptCondition", "ports": {"code": "x > 1"}}}, "n1"),
    "never read": ("BT0402", {"n1": {"type": "Act", "ports": {"result": "{k}"}}}, "n1"),
    "unknown tree": ("BT0501", {"n1": {"type": "SubTree", "tree": "Nope"}}, "n1"),
    "two subtrees of one name": (
        "BT0503",
        {
            "n1": {"type": "Sequence", "children": ["a", "b"]},
            "a": {"type": "SubTree", "tree": "Other", "name": "x"},
            "b": {"type": "SubTree", "tree": "Other", "name": "x"},
        },
        "b",
    ),
    "bad autoremap": (
        "BT0505",
        {"n1": {"type": "SubTree", "tree": "Other", "attributes": {"_autoremap": "maybe"}}},
        "n1",
    ),
}


def test_who_tells_a_finding_in_another_language_gets_what_its_words_are_filled_with(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "Act", "ports": {"result": "{speed}"}},
        "b": {"type": "Act", "ports": {"speed": "{spead}"}},
    }
    found = find(make_project(nodes), "BT0401").to_json()
    assert found["values"]["key"] == "spead"
    assert found["values"]["near"] == "speed"
    rule = rules()["BT0401"]
    assert found["message"] == rule.message.format(**found["values"])
    assert found["hint"] == rule.hint.format(**found["values"])


@pytest.mark.parametrize("name", CASES)
def test_finding_and_its_place(make_project, name):
    code, nodes, node = CASES[name]
    found = find(make_project(nodes, trees={"Other": {"n1": LEAF}}), code)
    assert found.place.tree == "MainTree"
    assert found.place.node == node
    assert found.place.file == "trees/MainTree.json"
    assert found.place.line == 1
    assert found.place.column is not None
    assert found.place.column > 1
    assert found.message
    assert found.hint
    assert found.severity is rules()[code].severity


@pytest.mark.parametrize(
    ("nodes", "code"),
    [
        ({"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": {"type": "Act"}, "b": LEAF}, "BT0114"),
        ({"n1": {"type": "Act", "ports": {"speed": "{=}", "result": "{speed}"}}}, "BT0401"),
        ({"n1": {"type": "Act", "ports": {"flag": "TRUE", "count": "-3", "speed": "1e3"}}}, "BT0204"),
        ({"n1": {"type": "Open", "ports": {"text": "a{b"}}}, "BT0203"),
        ({"n1": {"type": "TestNode", "ports": {"anything": "1"}}}, "BT0202"),
    ],
)
def test_what_is_right_is_not_reported(make_project, nodes, code):
    assert code not in [item.code for item in check(make_project(nodes))]


def test_skippable_child_lets_the_next_be_reached(make_project):
    skipped = {**LEAF, "conditions": {"_skipIf": "true"}}
    nodes = {"n1": {"type": "Fallback", "children": ["a", "b"]}, "a": skipped, "b": LEAF}
    assert "BT0114" not in [item.code for item in check(make_project(nodes))]


def test_suggestion_of_the_nearest_name(make_project):
    assert "Sequence" in find(make_project({"n1": {"type": "Sequenc"}}), "BT0102").hint
    assert "speed" in find(make_project({"n1": {"type": "Act", "ports": {"sped": "1"}}}), "BT0202").hint


def test_missing_main_tree(make_project):
    found = find(make_project({"n1": LEAF}, main_tree="MainTre"), "BT0100")
    assert found.place.file == "project.json"
    assert "MainTree" in found.hint


def test_a_universe_cannot_be_called_as_what_means_none():
    project = load({"trees/MainTree.json": b"{}", "universes/none.yaml": b"", "universes/nones.yaml": b""})
    (found,) = [item for item in check(project) if item.code == "BT0031"]
    assert found.is_error
    assert (found.place.file, found.place.line) == ("universes/none.yaml", 1)
    assert "universes/none.yaml" in found.hint


def test_empty_trees(make_project):
    assert find(make_project({}), "BT0101").is_error
    project = make_project({"n1": LEAF}, trees={"Empty": {}})
    assert find(project, "BT0115").severity is Severity.NOTE
    assert not [item for item in check(project) if item.is_error]


def test_a_ring_of_subtrees_is_one_finding(make_project):
    call = {"n1": {"type": "SubTree", "tree": "B"}}
    project = make_project(
        {"n1": {"type": "SubTree", "tree": "A"}},
        trees={"A": call, "B": {"n1": {"type": "SubTree", "tree": "A"}}},
    )
    rings = [item for item in check(project) if item.code == "BT0502"]
    assert [item.place.tree for item in rings] == ["B"]
    assert "A → B → A" in rings[0].message


def test_each_ring_is_a_finding_of_its_own(make_project):
    def call(*targets):
        nodes = {f"n{target}": {"type": "SubTree", "tree": target} for target in targets}
        return {"n1": {"type": "Sequence", "children": list(nodes)}, **nodes}

    project = make_project(call("A", "A", "C"), trees={"A": call("A", "B"), "B": call("A"), "C": call("C")})
    rings = [(item.place.tree, item.place.node) for item in check(project) if item.code == "BT0502"]
    assert rings == [("A", "nA"), ("B", "nA"), ("C", "nC")]


def test_other_spellings_of_root_name_a_tree(make_project):
    project = make_project({"n1": {"type": "SubTree", "tree": "ROOT"}}, trees={"ROOT": {"n1": LEAF}})
    assert [item.code for item in check(project)] == []


GLOBAL = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence><SubTree ID="Set" {given}/><Script code="y := g"/></Sequence></BehaviorTree>
<BehaviorTree ID="Set">{inside}</BehaviorTree></root>"""


@pytest.mark.parametrize(
    ("given", "inside", "lost"),
    [
        ('x="{@g}"', '<Script code="x := 1"/>', ["x"]),
        ('x="{@g}"', '<SetBlackboard value="1" output_key="x"/>', ["x"]),
        ('x="{@g}"', '<LoopInt queue="1" value="{x}"><AlwaysSuccess/></LoopInt>', ["x"]),
        ('x="{@g}"', '<ScriptCondition code="x == 1"/>', []),
        ('x="{@g}"', '<Unknown value="{x}"/>', []),
        ("", '<Script code="@g := 1"/>', []),
        ('x="{g}"', '<Script code="x := 1"/>', []),
    ],
)
def test_a_write_through_a_remap_to_a_global_is_warned_of(given, inside, lost):
    found = check(from_xml(GLOBAL.replace("{given}", given).replace("{inside}", inside)))
    warnings = [item for item in found if item.code == "BT0404"]
    assert [item.place.port for item in warnings] == lost
    for item in warnings:
        assert "BehaviorTree.CPP loses this write" in item.message
        assert item.hint == "Write {@g} inside “Set”, and do not pass it."


CONSTANT = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence><SubTree ID="Run" {given}/></Sequence></BehaviorTree>
<BehaviorTree ID="Run"><SubTree ID="Inner" code="{code}"/></BehaviorTree>
<BehaviorTree ID="Inner"><Script code="{code}"/></BehaviorTree></root>"""


@pytest.mark.parametrize(
    ("given", "codes"), [('code="x := 1"', []), ("", ["BT0303"]), ('code="{later}"', ["BT0303"])]
)
def test_a_script_may_be_a_constant_of_its_subtree(given, codes):
    found = check(from_xml(CONSTANT.replace("{given}", given)))
    assert [item.code for item in found if item.code == "BT0303"] == codes


DRIVE = b"""<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><SubTree ID="Drive" distance="%s" times="%s"/></BehaviorTree>
<BehaviorTree ID="Drive"><Script code="x := distance * times"/></BehaviorTree>
<TreeNodesModel><SubTree ID="Drive">
  <input_port name="distance" type="double"/><input_port name="times" type="int"/>
</SubTree></TreeNodesModel></root>"""


@pytest.mark.parametrize(
    ("distance", "times", "codes"),
    [
        (b"2.0", b"3", []),
        (b"{there}", b"{=}", []),
        (b"2", b"3", [("BT0506", "distance")]),
        (b"far", b"3.5", [("BT0204", "distance"), ("BT0206", "times")]),
        (b"{there", b"{}", [("BT0203", "distance"), ("BT0207", "times")]),
    ],
)
def test_values_of_a_subtree_suit_the_ports_of_its_tree(distance, times, codes):
    found = [item for item in check(from_xml(DRIVE % (distance, times))) if item.code[:4] in {"BT02", "BT05"}]
    assert [(item.code, item.place.port) for item in found] == codes


def test_key_that_is_not_passed_to_a_subtree(make_project):
    inner = {"n1": {"type": "Act", "ports": {"speed": "{fast}"}}}
    outer = {"n1": {"type": "SubTree", "tree": "Inner"}}
    found = find(make_project(outer, trees={"Inner": inner}), "BT0403")
    assert (found.place.tree, found.place.node, found.place.port) == ("MainTree", "n1", "fast")
    for ports, attributes in (({"fast": "1.5"}, {}), ({}, {"_autoremap": "true"})):
        node = {"type": "SubTree", "tree": "Inner", "ports": ports, "attributes": attributes}
        assert "BT0403" not in [
            item.code for item in check(make_project({"n1": node}, trees={"Inner": inner}))
        ]


def test_output_of_a_subtree_is_a_write_of_its_caller(make_project):
    inner = {"n1": {"type": "Act", "ports": {"result": "{out}"}}}
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "SubTree", "tree": "Inner", "ports": {"out": "{speed}"}},
        "b": {"type": "Act", "ports": {"speed": "{speed}"}},
    }
    assert check(make_project(nodes, trees={"Inner": inner})) == ()


def test_global_key_written_in_a_subtree(make_project):
    nodes = {
        "n1": {"type": "Sequence", "children": ["a", "b"]},
        "a": {"type": "SubTree", "tree": "Inner"},
        "b": {"type": "Act", "ports": {"speed": "{k}"}},
    }
    inner = {"n1": {"type": "Script", "ports": {"code": "@k := 1"}}}
    found = [item.code for item in check(make_project(nodes, trees={"Inner": inner}))]
    assert "BT0403" not in found


@pytest.mark.parametrize(
    ("source", "code"),
    [
        ("def broken(:\n", "BT0601"),
        ("class Other: pass\n", "BT0602"),
        ("class Act:\n    def update(self): pass\n", "BT0603"),
        ("import py_trees\nclass Act(py_trees.behaviour.Behaviour):\n    pass\n", "BT0604"),
        ("x = 1\nfrom elsewhere import Act\n", "BT0607"),
    ],
)
def test_findings_in_actions_name_file_and_line(make_project, source, code):
    found = find(make_project({"n1": {"type": "Act"}}, actions={"Act": source}), code)
    assert found.place.file == "actions/Act.py"
    assert found.place.line


def test_action_named_like_a_builtin(make_project):
    project = make_project({"n1": LEAF}, actions={"Sequence": "class Sequence: pass"})
    assert find(project, "BT0609").place.file == "actions/Sequence.py"
