"""The syntax of a region: own kinds of nodes, own names, and nothing of the document."""

from __future__ import annotations

import ast
import types
from typing import Any
from xml.sax.saxutils import quoteattr

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.tree_gardener.trees import Succeeding, load
from tree_gardener import LoadError, Tree
from tree_gardener.blackboard import Blackboard
from tree_gardener.debugging import Debugger
from tree_gardener.debugging.watches import Watch
from tree_gardener.debugging.wiring import RESULTS, Wanted, Wiring
from tree_gardener.generated import code
from tree_gardener.generated.parts import Planner, Variant
from tree_gardener.generated.syntax import NODES
from tree_gardener.generated.writer import ATTRIBUTES, FIRST_LINE, FIXED, VARIABLES, Writer, meanings
from tree_gardener.node import Control
from tree_gardener.script import Environment
from tree_gardener.script import compiled as compiled_scripts

HOSTILE = (
    "__import__('os').system('true')",
    '"); __import__("os"); ("',
    "a\nimport os\n",
    "'\"\\",
    "RUNNING",
    "c0",
    "__builtins__",
    "é {} %s \u2028",
    "lambda: eval",
)
VARIANTS = [
    Variant(*(bool(number & bit) for bit in (1, 2, 4, 8, 16, 32)))
    for number in range(64)
    if number & 6 != 4 and number & 48 != 32
]
BODY = (
    "<Sequence name={name} _skipIf={test} _post={script}><Fallback><ScriptCondition code={test} name={name}/>"
    '<Succeeding name={name} port={literal} _failureIf={test}/><Sleep msec="1"/></Fallback>'
    "<Inverter name={name}><ReactiveFallback><Script code={script}/><AlwaysFailure/></ReactiveFallback>"
    "</Inverter><ParallelAll><Succeeding name={name} port={literal}/><Succeeding/></ParallelAll></Sequence>"
)


class Ported(Succeeding):
    """A leaf that takes any text."""

    INPUT_PORTS = {"port": str}  # noqa: RUF012 - as users write


class Asked(Debugger):
    """A debugger that is asked round the tick of each node."""

    def __init__(self) -> None:
        super().__init__(lambda stop: None)

    def attach(self, wiring: Wiring) -> None:
        super().attach(wiring)
        tests = (Watch("1 < 2", Environment(Blackboard(), {})),)
        asked = Wanted(before=True, results=RESULTS, halted=True)
        wanted = (asked, asked._replace(tests=tests))
        wiring.choose({node.uid: wanted[node.uid % 2] for node in wiring.tree.nodes})


def tree_of(text: str) -> Tree:
    """A tree with a text as names, literals, keys, values of ports and enum constants."""
    literal = text.replace("'", "")
    words = {
        "name": text.replace("/", "_") or "n",
        "literal": text,
        "test": f"secret == '{literal}'",
        "script": f"secret := '{literal}'",
    }
    quoted = {word: quoteattr(value) for word, value in words.items()}
    body = BODY
    for word, value in quoted.items():
        body = body.replace(f"{{{word}}}", value)
    return load(body, nodes={"Succeeding": Ported}, enums={"GREEN": 2, text: 1})


def assert_harmless(module: ast.Module) -> None:
    for node in ast.walk(module):
        assert type(node) in NODES
        if isinstance(node, ast.Attribute):
            assert node.attr in ATTRIBUTES
        elif isinstance(node, ast.Constant):
            assert type(node.value) in (int, bool)
        elif isinstance(node, (ast.Name, ast.arg)):
            name = node.id if isinstance(node, ast.Name) else node.arg
            own = name[0] == "c" and name[1:].isdecimal()
            assert own or name in FIXED or name in VARIABLES or (name[:5] == "ticks" and name[5:].isdecimal())
        elif isinstance(node, (ast.FunctionDef, ast.ExceptHandler)):
            assert node.name in ("tick", "error")


def assert_safe(tree: Tree, monkeypatch: pytest.MonkeyPatch) -> None:
    """Generates all code of a tree, and looks at what is compiled and at the functions."""
    compiled: list[ast.Module] = []
    compile_module = compiled_scripts.compile_module

    def watched(module: ast.Module, file: str) -> types.CodeType | None:
        compiled.append(module)
        return compile_module(module, file)

    monkeypatch.setattr(code, "compile_module", watched)
    code._codes.clear()
    tree.generated_source()
    monkeypatch.undo()
    assert compiled
    for module in compiled:
        assert_harmless(module)
    functions = [node.quick for node in tree.nodes if isinstance(node, Control) and node.quick is not None]
    assert functions
    for function in functions:
        if function.__closure__ is not None:  # in slices
            continue
        assert isinstance(function, types.FunctionType)
        assert function.__globals__ == {"__builtins__": {}}
        assert set(function.__code__.co_names) <= ATTRIBUTES
        assert all(type(each) in (int, bool, type(None)) for each in function.__code__.co_consts)


@pytest.mark.parametrize("text", HOSTILE)
@pytest.mark.parametrize("is_debugged", [False, True])
def test_hostile_documents_get_into_no_source(
    text: str, *, is_debugged: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    tree = tree_of(text)
    if is_debugged:
        tree.debug(Asked())
    assert_safe(tree, monkeypatch)


@given(st.text(alphabet="ab_'\"\n\x00\ud800(){}\\;.", max_size=12))
@settings(max_examples=60, deadline=None)
def test_random_documents_get_into_no_source(text: str) -> None:
    try:
        tree = tree_of(text)
    except (LoadError, UnicodeEncodeError):
        return  # refused, as NUL and lone surrogates are
    with pytest.MonkeyPatch.context() as monkeypatch:
        assert_safe(tree, monkeypatch)


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_variant_is_harmless_and_each_value_has_its_line(variant: Variant) -> None:
    tree = tree_of("text")
    tree.observe(lambda changes: None)
    tree.debug(Asked())
    wiring = tree._hooks.wiring
    planner = Planner(variant, tree.count_results() if variant.counts else None, lambda node: False, wiring)
    waiting = [tree.nodes[0]]
    while waiting:
        regions = planner.regions(waiting.pop())
        waiting += planner.called
        for region in regions:
            writer = Writer(variant)
            assert_harmless(writer.function(region.root))
            own = [int(name[1:]) for name in writer.parameters() if name not in FIXED]
            assert own == sorted(set(own))
            assert max(own) < len(region.values)
            lines = dict(meanings(region.root))
            assert sorted(lines) == list(range(FIRST_LINE, FIRST_LINE + len(region.values)))


def test_marks_that_wait_for_their_bundle_are_known_by_line() -> None:
    tree = load(
        "<Sequence><Succeeding/><Sequence><Succeeding/><Succeeding/></Sequence><Inverter><Succeeding/>"
        "</Inverter></Sequence>"
    )
    tree.observe(lambda changes: None)
    variant = Variant(is_observed=True, marks=False, times=False, counts=False)
    (region,) = Planner(variant, None, lambda node: False).regions(tree.nodes[0])
    lines = dict(meanings(region.root))

    def waiting(line: int) -> list[Any]:
        return [(region.values[place].uid, index) for place, index in lines[line].pending]

    inner = region.root.children[1]
    assert waiting(FIRST_LINE + inner.children[1].place("u")) == [(2, 0), (4, 0)]
    bundle, inverter = region.root.children[2:4]
    assert waiting(FIRST_LINE + bundle.first) == [(2, 0), (4, 0), (5, 0), (3, 0)]
    assert waiting(FIRST_LINE + inverter.first) == []
