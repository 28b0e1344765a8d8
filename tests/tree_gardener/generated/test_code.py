"""Code is shared by shape, and freed with the last tree."""

from __future__ import annotations

import gc
import threading
import types
import weakref
from typing import TYPE_CHECKING, Any

from tests.tree_gardener.trees import Failing, Succeeding, load
from tree_gardener import Status, Tree
from tree_gardener.generated import code
from tree_gardener.generated.code import Code, code_of, source_of
from tree_gardener.generated.parts import Planner, Region, Variant
from tree_gardener.generated.writer import FIXED
from tree_gardener.node import Control

if TYPE_CHECKING:
    import pytest

BARE = Variant(is_observed=False, marks=False, times=False, counts=False)


def region_of(body: str, **nodes: Any) -> Region:
    tree = load(body, nodes=nodes or None)
    (region,) = Planner(BARE, None, lambda node: False).regions(tree.nodes[0])
    return region


def quick(tree: Tree) -> types.FunctionType:
    node = tree.nodes[0]
    assert isinstance(node, Control)
    assert isinstance(node.quick, types.FunctionType)
    return node.quick


def test_regions_of_one_shape_share_their_code() -> None:
    first, second = (region_of("<Sequence><Succeeding/><Succeeding/></Sequence>") for _ in range(2))
    shared = code_of(first, BARE)
    assert shared is code_of(second, BARE)
    assert isinstance(shared, Code)
    assert code_of(region_of("<Fallback><Succeeding/><Succeeding/></Fallback>"), BARE) is not shared


def test_other_classes_get_a_copy_of_the_code() -> None:
    body = "<Sequence><A/><A/></Sequence>"
    first, second = region_of(body, A=Succeeding), region_of(body, A=Failing)
    one, other = code_of(first, BARE), code_of(second, BARE)
    assert one is not None
    assert other is not None
    assert one.code is not other.code
    assert one.code.co_code == other.code.co_code


def test_a_function_is_bound_by_position() -> None:
    region = region_of("<Sequence><Succeeding/></Sequence>")
    made = code_of(region, BARE)
    assert made is not None
    function = made.bind(region.values, dict.fromkeys(FIXED))
    assert isinstance(function, types.FunctionType)
    places = [place for place in made.parameters if isinstance(place, int)]
    assert function.__defaults__ is not None
    assert list(function.__defaults__[-len(places) :]) == [region.values[place] for place in places]


def test_code_is_freed_with_the_last_tree() -> None:
    body = "<Sequence><Succeeding/><Inverter><Failing/></Inverter><Succeeding/></Sequence>"
    trees = [load(body) for _ in range(2)]
    for tree in trees:
        assert tree.tick_exactly_once() is Status.SUCCESS
    assert quick(trees[0]).__code__ is quick(trees[1]).__code__
    freed = weakref.ref(quick(trees[0]).__code__)
    trees.pop()
    del tree
    gc.collect()
    assert freed() is not None
    trees.pop()
    load("<AlwaysSuccess/>")  # py_trees' tools know the blackboard of the last tree
    gc.collect()
    assert freed() is None


def test_code_is_freed_although_a_class_leads_to_its_tree() -> None:
    class Own(Succeeding):
        trees: list[Tree] = []  # noqa: RUF012 - the reference from the class to the tree is the point

    tree = load("<Sequence><Own/><Own/></Sequence>", nodes={"Own": Own})
    Own.trees.append(tree)
    assert tree.tick_exactly_once() is Status.SUCCESS
    freed = weakref.ref(quick(tree).__code__)
    del tree, Own
    load("<AlwaysSuccess/>")  # py_trees' tools know the blackboard of the last tree
    gc.collect()
    assert freed() is None


def test_dropped_code_is_freed_while_the_tree_lives() -> None:
    tree = load("<Sequence><Succeeding/><Succeeding/><Failing/></Sequence>")
    tree.tick_exactly_once()
    freed = weakref.ref(quick(tree).__code__)
    tree.generate_code(on=False)
    gc.collect()
    assert freed() is None
    assert tree.tick_exactly_once() is Status.FAILURE


def test_what_the_compiler_cannot_take_runs_by_the_nodes_own_methods(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(code, "compile_module", lambda module, file: None)
    code._codes.clear()
    tree = load("<Sequence><Succeeding/><Failing/></Sequence>")
    assert tree.tick_exactly_once() is Status.FAILURE
    assert tree.nodes[0].quick is None  # type: ignore[attr-defined]
    assert tree.generated_source() == ""


def test_trees_of_several_threads_are_compiled_one_after_the_other() -> None:
    found: list[Status] = []

    def run(number: int) -> None:
        body = "".join("<Succeeding/>" if number >> bit & 1 else "<AlwaysSuccess/>" for bit in range(7))
        found.append(load(f"<Sequence>{body}</Sequence>").tick_exactly_once())

    threads = [threading.Thread(target=run, args=(number,)) for number in range(24)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [Status.SUCCESS] * 24


def test_the_source_is_that_of_the_code() -> None:
    region = region_of("<Sequence><Succeeding/></Sequence>")
    source = source_of(region, BARE)
    assert source.startswith("def tick(")
    compile(source, "<source>", "exec")
