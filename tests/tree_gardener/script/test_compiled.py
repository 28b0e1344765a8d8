"""Compiled scripts do what the evaluator does: values, writes, events and errors."""

from __future__ import annotations

import dataclasses
import functools
import gc
import json
import math
import threading
import types
import weakref
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tree_gardener import Status, Tree
from tree_gardener.blackboard import Blackboard, Entry
from tree_gardener.errors import PortError, ScriptError
from tree_gardener.script import Environment, bind_run, bind_test, compile_script, compiled, generated_source
from tree_gardener.script.generator import MAX_DEPTH, MAX_PARTS
from tree_gardener.values import ANY, BOOL, DOUBLE, INT, STRING

TABLE = Path(__file__).parents[2] / "conformance" / "script_table.json"
ENUMS = {"RED": 5, "GREEN": 1, "text": 0}
OBJECT = object()
VALUES = [
    *(0, 1, 2, -3, 7, 2**53, -(2**53), 2**63, 10**400, True, False),
    *(0.0, -0.0, 1.0, 0.5, -2.5, 3.0, 1e300, 2.0**53, 2.0**63, math.inf, -math.inf, math.nan),
    *("", "a", "1", "1.5x", "true", "RED", "nan"),
    *(OBJECT, None, (1, 2), type("Real", (float,), {})(4.5), type("Text", (str,), {})("a")),
]
TYPES = [None, INT, DOUBLE, BOOL, STRING, ANY]
NAMES = ["a", "b", "c", "d", "@a", "@e", "outer", "none", "RED"]


@dataclasses.dataclass
class Scene:
    """A scope within another one, made again for each way of running."""

    inner: list[tuple[str, Any, Any]]
    outer: list[tuple[str, Any, Any]]
    autoremap: bool

    def board(self) -> Blackboard:
        root = Blackboard()
        board = root.child()
        board.remapping["outer"] = "a"
        board.remapping["c"] = "@e"
        board.autoremap = self.autoremap
        for scope, entries in ((root, self.outer), (board, self.inner)):
            for key, kind, value in entries:
                entry = scope.entries[key] = Entry(scope, key, kind)
                if value is not Ellipsis:
                    entry.value = value
        return board


def entries(keys: str) -> st.SearchStrategy[list[tuple[str, Any, Any]]]:
    return st.lists(
        st.tuples(st.sampled_from(keys), st.sampled_from(TYPES), st.sampled_from([*VALUES, ...])), max_size=4
    )


SCENES = st.builds(Scene, entries("abcd"), entries("abe"), st.booleans())
ATOMS = st.one_of(
    st.sampled_from(NAMES),
    st.sampled_from(["0", "1", "2", "3.0", "0.5", "1e308", "9007199254740992", "true", "false"]),
    st.sampled_from(["'a'", "'1'", "'RED'", "''"]),
)


@st.composite
def expressions(draw: st.DrawFn, depth: int = 2) -> str:
    if depth == 0 or draw(st.integers(0, 3)) == 0:
        return draw(ATOMS)
    left, right, last = (draw(expressions(depth - 1)) for _ in range(3))
    forms = [
        f"{draw(st.sampled_from('-~!'))}({left})",
        f"(({left}) ? ({right}) : ({last}))",
        f"({draw(st.sampled_from(NAMES))} {draw(ASSIGNS)} {left})",
        f"({left}) {draw(COMPARES)} ({right}) {draw(COMPARES)} ({last})",
        f"({left}) {draw(COMPARES)} ({right})",
        *[f"({left}) {draw(st.sampled_from(OPERATORS))} ({right})"] * 4,
    ]
    return draw(st.sampled_from(forms))


ASSIGNS = st.sampled_from([":=", "=", "+=", "-=", "*=", "/="])
COMPARES = st.sampled_from(["==", "!=", "<", ">", "<=", ">="])
STATEMENTS = st.one_of(
    expressions(), st.builds(lambda *parts: " ".join(parts), st.sampled_from(NAMES), ASSIGNS, expressions())
)
SCRIPTS = st.lists(STATEMENTS, min_size=1, max_size=3).map("; ".join)


def outcome(scene: Scene, text: str, *, is_condition: bool, is_compiled: bool) -> list[Any]:
    """Runs a script three times, and returns all that can be seen of it."""
    board = scene.board()
    environment = Environment(board, ENUMS, 7)
    seen: list[Any] = []
    if is_compiled:
        call = (bind_test if is_condition else bind_run)(text, environment)
        assert isinstance(call, types.FunctionType)
        assert call.__globals__ == {"__builtins__": {}}
    else:
        script = compile_script(text)

        def call() -> Any:
            return script.test(environment) if is_condition else script.run(environment)

    def journal(entry: Entry, writer: int) -> None:
        path = "root" if entry.board is board.root else "inner"
        seen.append((path, entry.key, exactly(entry.value), entry.sequence, writer))

    for journalled in (None, journal, journal):
        board.journal = board.root.journal = journalled
        try:
            seen.append(exactly(call()))
        except (ScriptError, PortError, OverflowError) as error:
            seen.append((type(error), str(error), getattr(error, "span", None), getattr(error, "hint", None)))
    for scope in (board, board.root):
        seen += [
            (key, entry.type, exactly(entry.value), entry.sequence) for key, entry in scope.entries.items()
        ]
    return seen


def exactly(value: Any) -> tuple[type, Any]:
    """A value that equals only itself: 1, 1.0, True, -0.0 and NaN differ."""
    return type(value), repr(value) if isinstance(value, float) else value


@functools.lru_cache(8)
def kept(text: str) -> tuple[Any, Any]:
    """Keeps the code of a script while scenes alternate: it is shared, and gone with its last user."""
    environment = Environment(Blackboard(), ENUMS, 7)
    return bind_run(text, environment), bind_test(text, environment)


def assert_alike(scene: Scene, text: str) -> None:
    try:
        compile_script(text)
    except ScriptError:
        return
    kept(text)
    for is_condition in (False, True):
        evaluated = outcome(scene, text, is_condition=is_condition, is_compiled=False)
        assert outcome(scene, text, is_condition=is_condition, is_compiled=True) == evaluated


@given(SCENES, SCRIPTS)
@settings(max_examples=300, deadline=None)
def test_random_scripts_do_the_same_in_both_ways(scene: Scene, text: str) -> None:
    assert_alike(scene, text)


OPERATORS = ["+", "-", "*", "/", "..", "&", "|", "^", "&&", "||", "==", "!=", "<", ">", "<=", ">="]


@pytest.mark.parametrize("symbol", [*OPERATORS, ":=", "=", "+=", "-=", "*=", "/="])
def test_every_pair_of_values_does_the_same_in_both_ways(symbol: str) -> None:
    texts = [f"a {symbol} b", f"a {symbol} 1", f"a {symbol} 'a'", f"a {symbol} (b > 0)", f"a {symbol} 0.5"]
    for left in VALUES:
        for right in VALUES[::4]:
            scene = Scene([("a", None, left), ("b", None, right)], [], autoremap=False)
            assert_alike(scene, texts[0])
        for text in texts[1:]:
            assert_alike(Scene([("a", None, left), ("b", None, 1)], [], autoremap=False), text)


STEPS = ["a := a + 1", "a *= 3", "a -= 9007199254740991", "a = a + 2.0", "a := 'x' .. b", "a := b .. 'x'"]


@pytest.mark.parametrize(
    "text", ["-a", "~a", "!a", "a", "a ? 1 : b", "a += 1; a -= 0.5", "x := a; x = b", *STEPS]
)
def test_every_value_does_the_same_in_both_ways(text: str) -> None:
    for kind in TYPES:
        for value in [*VALUES, ...]:
            assert_alike(Scene([("a", kind, value), ("b", None, 2)], [], autoremap=False), text)


def test_the_table_of_behaviortree_cpp_does_the_same_in_both_ways() -> None:
    scene = Scene([("a", INT, 3), ("b", None, 2.5), ("d", STRING, "text")], [], autoremap=False)
    for row in json.loads(TABLE.read_text()):
        assert_alike(scene, row["expr"])


@pytest.mark.parametrize(
    "text",
    [
        "1" + " + a" * (MAX_DEPTH + 1),
        "; ".join(["a := 1"] * MAX_PARTS),
        "!" * 99 + "a",
        "(" * 90 + "a" + ")" * 90,
    ],
)
def test_what_is_too_large_is_evaluated(text: str) -> None:
    board = Blackboard()
    board["a"] = 1
    value = bind_run(text, Environment(board, {}))()
    assert value == compile_script(text).run(Environment(board, {}))
    if "(" not in text:
        assert generated_source(text) == ""


def test_places_with_one_script_share_its_code_until_the_last_is_gone() -> None:
    text = "shared_code_of_this_test := 1"
    first, second = (bind_run(text, Environment(Blackboard(), {})) for _ in range(2))
    assert isinstance(first, types.FunctionType)
    assert isinstance(second, types.FunctionType)
    assert first.__code__ is second.__code__
    code = weakref.ref(first.__code__)
    del first
    gc.collect()
    assert code() is not None
    del second
    gc.collect()
    assert code() is None
    assert not any(key[0] == text for key in compiled._codes)


def test_trees_free_their_code() -> None:
    for number in range(3):
        name = f"code_of_a_tree_{number}"
        node = f'<ScriptCondition code="1 &lt; {name}" _skipIf="{name} &gt; 9"/>'
        tree = Tree.from_xml(f'<root BTCPP_format="4"><BehaviorTree ID="Main">{node}</BehaviorTree></root>')
        tree.blackboard[name] = 2
        assert tree.tick_exactly_once() is Status.SUCCESS
        del tree
    gc.collect()
    kept = {key[0] for key in compiled._codes if "code_of_a_tree" in key[0]}
    assert not [text for text in kept if "code_of_a_tree_2" not in text]


def test_scripts_compile_in_several_threads() -> None:
    found: list[float] = []

    def work(offset: int) -> None:
        for number in range(20):
            text = f"{offset} + {number} + a * 2"
            board = Blackboard()
            board["a"] = 1
            found.append(bind_run(text, Environment(board, {}))() - offset - number)

    threads = [threading.Thread(target=work, args=(100 * index,)) for index in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [2.0] * 80


def test_another_way_to_find_entries_is_respected() -> None:
    class Fixed(Blackboard):
        def find(self, key: str) -> Entry | None:
            return super().find("real" if key == "alias" else key)

    board = Fixed()
    board["real"] = 3
    assert bind_run("alias + 1", Environment(board, {}))() == 4
