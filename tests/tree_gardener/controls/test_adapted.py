"""Composites and decorators of py_trees in the engine, beside the same tree in py_trees itself."""

from __future__ import annotations

import random
from typing import Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import document, load, recording
from tree_gardener import LoadError, Status, TickError, Tree
from tree_gardener.controls.adapted import adapted
from tree_gardener.ports import Port, get_input

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


class Seq(py_trees.composites.Sequence):
    def __init__(self, name: str, children: Any = None) -> None:
        super().__init__(name, memory=True, children=children)


class Reactive(py_trees.composites.Sequence):
    def __init__(self, name: str, children: Any = None) -> None:
        super().__init__(name, memory=False, children=children)


class Choose(py_trees.composites.Selector):
    def __init__(self, name: str, children: Any = None) -> None:
        super().__init__(name, memory=True, children=children)


class Prefer(py_trees.composites.Selector):
    def __init__(self, name: str, children: Any = None) -> None:
        super().__init__(name, memory=False, children=children)


class All(py_trees.composites.Parallel):
    def __init__(self, name: str, children: Any = None) -> None:
        policy = py_trees.common.ParallelPolicy.SuccessOnAll(synchronise=False)
        super().__init__(name, policy=policy, children=children)


class Twice(py_trees.decorators.Repeat):
    def __init__(self, name: str, child: Any) -> None:
        super().__init__(name, child=child, num_success=2)


class Not(py_trees.decorators.Inverter):
    pass


COMPOSITES: dict[str, Any] = {cls.__name__: cls for cls in (Seq, Reactive, Choose, Prefer, All)}
DECORATORS: dict[str, Any] = {cls.__name__: cls for cls in (Twice, Not)}


class Lettered(py_trees.behaviour.Behaviour):
    """Returns the letters of its name one after the other, and logs that."""

    log: ClassVar[list[str]] = []

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.letters = name.partition(".")[2]
        self.cursor = 0

    def initialise(self) -> None:
        self.log.append(f"start {self.name}")

    def update(self) -> PyTreesStatus:
        letter = self.letters[min(self.cursor, len(self.letters) - 1)]
        self.cursor += 1
        self.log.append(f"{self.name} {letter}")
        return {"R": R, "S": S, "F": F}[letter]


def generate(rng: random.Random, depth: int, names: Any) -> tuple[str, list[Any]]:
    """A node: its type or its name, and its children."""
    kind = rng.random()
    if depth == 0 or kind < 0.3:
        letters = "".join(rng.choice("RSSFF") for _ in range(rng.randint(1, 6)))
        return f"L{next(names)}.{letters}", []
    pool, number = (COMPOSITES, rng.randint(1, 3)) if kind < 0.8 else (DECORATORS, 1)
    return rng.choice(list(pool)), [generate(rng, depth - 1, names) for _ in range(number)]


def as_xml(node: tuple[str, list[Any]]) -> str:
    name, children = node
    if not children:
        return f'<Lettered name="{name}"/>'
    return f"<{name}>{''.join(as_xml(child) for child in children)}</{name}>"


def as_stock(node: tuple[str, list[Any]]) -> Any:
    name, children = node
    if not children:
        return Lettered(name)
    below = [as_stock(child) for child in children]
    return COMPOSITES[name](name, children=below) if name in COMPOSITES else DECORATORS[name](name, below[0])


def test_random_trees_of_py_trees_run_as_in_py_trees(monkeypatch: pytest.MonkeyPatch) -> None:
    for seed in range(400):
        rng = random.Random(seed)  # noqa: S311 - a reproducible tree, no secret
        node = generate(rng, 3, iter(range(1000)))
        tree = Tree.from_xml(document(as_xml(node)), {"Lettered": Lettered, **COMPOSITES, **DECORATORS})
        stock = as_stock(node)
        for tick in range(10):
            logs: list[list[str]] = [[], []]
            monkeypatch.setattr(Lettered, "log", logs[0])
            stock.tick_once()
            monkeypatch.setattr(Lettered, "log", logs[1])
            found = tree.tick_exactly_once()
            assert (found.name, logs[1]) == (stock.status.name, logs[0]), f"seed {seed}, tick {tick}"
            if rng.random() < 0.1:
                stock.stop(PyTreesStatus.INVALID)
                tree.halt()
        assert all(status is Status.IDLE for status in [node.status for node in _halted(tree)])


def _halted(tree: Tree) -> Any:
    tree.halt()
    return tree.nodes


def test_a_skipped_child_reads_invalid_and_skips_a_sequence() -> None:
    nodes = {**COMPOSITES, **DECORATORS, "K": recording(Status.SKIPPED)}
    assert load("<Seq><K/><Succeeding/></Seq>", nodes=nodes).tick_exactly_once() is Status.SKIPPED
    assert load("<Choose><K/><Succeeding/></Choose>", nodes=nodes).tick_exactly_once() is Status.SUCCESS


def test_invalid_without_a_skip_counts_as_failure_and_is_said_once() -> None:
    class Odd(py_trees.decorators.Decorator):
        def update(self) -> PyTreesStatus:
            return PyTreesStatus.INVALID

    tree = load("<Odd><Succeeding/></Odd>", nodes={"Odd": Odd})
    said: list[str] = []
    tree.on_warning = lambda node, text: said.append(text)
    assert [tree.tick_exactly_once() for _ in range(2)] == [Status.FAILURE] * 2
    assert len(said) == 1


def test_ports_setup_and_shutdown_reach_the_users_object() -> None:
    class Own(py_trees.composites.Composite):
        INPUT_PORTS: ClassVar = {"x": Port(int)}
        calls: ClassVar[list[Any]] = []

        def setup(self, **kwargs: Any) -> None:
            self.calls.append(kwargs["node"])

        def tick(self) -> Any:
            for child in self.children:
                yield from child.tick()
            self.calls.append(get_input(self, "x"))
            self.status = S
            yield self

        def shutdown(self) -> None:
            self.calls.append("shutdown")

    tree = load('<Own x="3"><Succeeding/></Own>', nodes={"Own": Own})
    tree.setup(node="ros")
    assert tree.tick_exactly_once() is Status.SUCCESS
    tree.shutdown()
    assert Own.calls == ["ros", 3, "shutdown"]


def test_a_childs_error_names_the_child() -> None:
    tree = load("<Seq><Raising name='bad'/></Seq>", nodes=COMPOSITES)
    with pytest.raises(TickError) as raised:
        tree.tick_exactly_once()
    assert raised.value.path == "bad"


def test_a_stop_that_raises_still_halts_the_children() -> None:
    class Bad(Seq):
        def stop(self, new_status: Any = PyTreesStatus.INVALID) -> None:
            if new_status is PyTreesStatus.INVALID:
                raise ValueError("stuck")
            super().stop(new_status)

    tree = load("<Bad><Running/></Bad>", nodes={"Bad": Bad})
    tree.tick_exactly_once()
    said: list[str] = []
    tree.on_warning = lambda _, text: said.append(text)
    tree.halt()
    assert "stuck" in said[0], said
    assert all(node.status is Status.IDLE for node in tree.nodes)


def test_a_class_that_needs_more_than_a_name_is_refused_with_the_reason() -> None:
    with pytest.raises(LoadError, match="cannot be made"):
        load("<X><Running/></X>", nodes={"X": py_trees.composites.Sequence})


class Note(py_trees.behaviour.Behaviour):
    """Notes what is called."""

    calls: ClassVar[list[str]] = []

    def setup(self, *, node: Any) -> None:
        self.calls.append(f"setup {self.name} with {node}")

    def update(self) -> PyTreesStatus:
        self.calls.append(f"update {self.name} with {get_input(self, 'x')}")
        return PyTreesStatus.RUNNING if self.name == "b" else S

    def terminate(self, new_status: PyTreesStatus) -> None:
        self.calls.append(f"terminate {self.name} {new_status.name}")

    def shutdown(self) -> None:
        self.calls.append(f"shutdown {self.name}")


class Patrol(py_trees.composites.Sequence):
    """Makes its children itself."""

    INPUT_PORTS: ClassVar = {"x": Port(int)}

    def __init__(self, name: str) -> None:
        super().__init__(name, memory=True)
        self.add_children([Note("a"), Note("b")])


class Closed(py_trees.decorators.Inverter):
    """Makes its child itself."""

    INPUT_PORTS: ClassVar = {"x": Port(int)}

    def __init__(self, name: str) -> None:
        super().__init__(name, child=Note("a"))


class Childless(py_trees.composites.Sequence):
    """Takes its children from the tree."""

    def __init__(self, name: str) -> None:
        super().__init__(name, memory=True)


HOLDING = {"Patrol": Patrol, "Closed": Closed, "Childless": Childless}


def test_a_class_that_holds_its_children_needs_none_in_the_tree() -> None:
    Note.calls.clear()
    tree = load('<Patrol x="3"/>', nodes=HOLDING)
    tree.setup(node="ros")
    assert tree.tick_exactly_once() is Status.RUNNING
    tree.shutdown()
    assert Note.calls == [
        *("setup a with ros", "setup b with ros"),
        *("update a with 3", "terminate a SUCCESS", "update b with 3"),
        *("terminate a INVALID", "terminate b INVALID", "shutdown a", "shutdown b"),
    ]


def test_a_decorator_that_makes_its_child_has_none_in_the_tree() -> None:
    assert load('<Closed x="3"/>', nodes=HOLDING).tick_exactly_once() is Status.FAILURE
    with pytest.raises(LoadError, match="Closed has 1 children and can have 0"):
        load('<Closed x="3"><Running/></Closed>', nodes=HOLDING)


def test_a_composite_without_any_child_is_refused() -> None:
    with pytest.raises(LoadError, match="Childless has 0 children and needs 1 or more"):
        load("<Childless/>", nodes=HOLDING)
    assert load("<Childless><Succeeding/></Childless>", nodes=HOLDING).tick_exactly_once() is Status.SUCCESS


def test_other_classes_are_not_adapted() -> None:
    assert adapted(py_trees.behaviour.Behaviour) is None
