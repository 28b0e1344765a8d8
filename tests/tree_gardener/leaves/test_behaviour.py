"""py_trees behaviours as leaves: which methods are called when, and their errors."""

from __future__ import annotations

from typing import Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import leaf, load, recording
from tree_gardener import Status, TickError
from tree_gardener.leaves.behaviour import LEAF_KINDS

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


def calls_of(cls: Any, ticks: int, *, halt: bool = False) -> list[str]:
    tree = load('<A name="a"/>', nodes={"A": cls})
    for _ in range(ticks):
        tree.tick_exactly_once()
    if halt:
        tree.halt()
    return list(leaf(tree, "a").calls)


def test_a_stateful_action_starts_runs_and_ends() -> None:
    assert calls_of(recording(R, R, S), 4) == [
        *("initialise", "update", "update", "update", "terminate SUCCESS from RUNNING"),
        *("initialise", "update", "terminate SUCCESS from SUCCESS"),
    ]


def test_a_halted_action_is_terminated_once() -> None:
    assert calls_of(recording(R), 2, halt=True) == [
        *("initialise", "update", "update", "terminate INVALID from RUNNING")
    ]


def test_an_idle_action_is_not_terminated_by_a_halt() -> None:
    assert calls_of(recording(S), 0, halt=True) == []


@pytest.mark.parametrize("kind", ["SyncAction", "Condition"])
def test_immediate_leaves_are_whole_activations(kind: str) -> None:
    assert calls_of(recording(F, kind=kind), 2) == [
        *("initialise", "update", "terminate FAILURE from INVALID"),
        *("initialise", "update", "terminate FAILURE from FAILURE"),
    ]


def test_a_sync_action_must_not_run_on() -> None:
    tree = load("<A/>", nodes={"A": recording(R, kind="SyncAction")})
    with pytest.raises(TickError, match="must not return RUNNING"):
        tree.tick_exactly_once()
    assert tree.nodes[0].status is Status.RUNNING


def test_a_condition_may_be_asked_again_while_running() -> None:
    tree = load("<A name='a'/>", nodes={"A": recording(R, S, kind="Condition")})
    assert [tree.tick_exactly_once(), tree.tick_exactly_once()] == [Status.RUNNING, Status.SUCCESS]
    assert leaf(tree, "a").calls.count("initialise") == 1


def test_update_may_return_our_statuses() -> None:
    for status in (Status.SUCCESS, Status.FAILURE, Status.RUNNING, Status.SKIPPED):
        assert load("<A/>", nodes={"A": recording(status)}).tick_exactly_once() is status


@pytest.mark.parametrize("wrong", [None, True, Status.IDLE, "SUCCESS", 2])
def test_anything_else_is_an_error_that_says_so(wrong: object) -> None:
    with pytest.raises(TickError, match=r"A\.update\(\) returned"):
        load("<A/>", nodes={"A": recording(wrong)}).tick_exactly_once()


@pytest.mark.parametrize("kind", ["StatefulAction", "SyncAction", "Condition"])
def test_invalid_counts_as_failure_and_is_said_once_a_node(kind: str) -> None:
    cls = recording(PyTreesStatus.INVALID, kind=kind)
    tree = load('<Fallback><A name="a"/><A name="b"/></Fallback>', nodes={"A": cls})
    said: list[str] = []
    tree.on_warning = lambda node, text: said.append(f"{node.path}: {text}")
    for _ in range(3):
        assert tree.tick_exactly_once() is Status.FAILURE
    text = "A.update() returned Status.INVALID, which counts as FAILURE"
    assert said == [f"a: {text}", f"b: {text}"]
    assert leaf(tree, "a").calls.count("update") == 3


def test_a_warning_goes_to_the_log_where_nobody_asked_for_it(caplog: pytest.LogCaptureFixture) -> None:
    tree = load('<A name="a"/>', nodes={"A": recording(PyTreesStatus.INVALID)})
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    [record] = caplog.records
    assert (record.name, record.levelname) == ("tree_gardener", "WARNING")
    assert "node 'a'" in record.getMessage()


@pytest.mark.parametrize("method", ["setup", "initialise", "update", "shutdown"])
def test_sys_exit_is_a_fault_of_the_node(method: str) -> None:
    def leave(*_: object, **__: object) -> None:
        raise SystemExit(0)

    cls = type("A", (recording(S),), {method: leave})
    tree = load('<A name="a"/>', nodes={"A": cls})

    def live() -> None:
        tree.setup()
        tree.tick_exactly_once()
        tree.shutdown()

    with pytest.raises(TickError, match=r"node 'a' \[A\]: the action called sys\.exit\(0\)"):
        live()


def test_an_exception_names_node_file_line_and_cause() -> None:
    tree = load('<Sequence><Raising name="arm" _bts_id="n7"/></Sequence>')
    with pytest.raises(TickError) as raised:
        tree.tick_exactly_once()
    error = raised.value
    assert (error.uid, error.path, error.node_id, error.node_type, error.tree_id) == (
        2,
        "arm",
        "n7",
        "Raising",
        "Main",
    )
    assert error.file.endswith("trees.py")
    assert error.line > 0
    assert error.message == "ValueError: out of order"
    assert "out of order" in error.traceback_text
    assert "leaves/behaviour.py" not in error.traceback_text
    assert isinstance(error.cause, ValueError)


def test_an_exception_can_count_as_failure() -> None:
    tree = load('<Fallback><Raising name="arm"/><Succeeding/></Fallback>')
    errors: list[TickError] = []
    tree.on_error = errors.append
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert [error.path for error in errors] == ["arm"]


def test_an_action_that_fails_because_it_raised_is_terminated() -> None:
    class A(recording(R)):  # type: ignore[misc]
        def update(self) -> Any:
            if self.calls.count("update") == 2:
                raise ValueError("no arm")
            return super().update()

    tree = load('<A name="a"/>', nodes={"A": A})
    tree.on_error = lambda _: None
    assert [tree.tick_exactly_once().letter for _ in range(3)] == ["R", "R", "F"]
    assert leaf(tree, "a").calls[-1] == "terminate FAILURE from RUNNING"


@pytest.mark.parametrize("method", ["initialise", "update"])
@pytest.mark.parametrize("kind", ["StatefulAction", "SyncAction", "Condition"])
def test_one_that_raises_in_its_first_tick_is_terminated_too(kind: str, method: str) -> None:
    def fail(_: object) -> None:
        raise ValueError("no arm")

    cls = type("A", (recording(S, kind=kind),), {method: fail})
    tree = load('<A name="a"/>', nodes={"A": cls})
    tree.on_error = lambda _: None
    assert tree.tick_exactly_once() is Status.FAILURE
    assert leaf(tree, "a").calls[-1] == "terminate FAILURE from INVALID"


class BadEnd(py_trees.behaviour.Behaviour):
    result = R

    def update(self) -> PyTreesStatus:
        return self.result

    def terminate(self, new_status: PyTreesStatus) -> None:
        raise self.error("stuck") if hasattr(self, "error") else RuntimeError("stuck")


@pytest.mark.parametrize("error", [RuntimeError, SystemExit])
@pytest.mark.parametrize("result", [S, F])
def test_an_exception_in_terminate_is_reported_with_its_line_and_changes_no_result(
    result: PyTreesStatus, error: type[BaseException]
) -> None:
    cls = type("Bad", (BadEnd,), {"result": result, "error": error})
    tree = load('<Bad name="bad"/>', nodes={"Bad": cls})
    said: list[str] = []
    tree.on_warning = lambda node, text: said.append(f"{node.path}: {text}")
    assert tree.tick_exactly_once().name == result.name
    [text] = said
    assert text.startswith("bad: terminate() raised ")
    assert "stuck" in text
    line = BadEnd.terminate.__code__.co_firstlineno + 1
    assert text.endswith(f"test_behaviour.py:{line}")


def test_halting_continues_after_an_exception_in_terminate() -> None:
    tree = load(
        '<Parallel failure_count="2"><Bad/><A name="a"/></Parallel>', nodes={"Bad": BadEnd, "A": recording(R)}
    )
    tree.on_warning = lambda *_: None
    tree.setup()
    tree.tick_exactly_once()
    tree.shutdown()
    assert leaf(tree, "a").calls[-2:] == ["terminate INVALID from RUNNING", "shutdown"]


def test_setup_gets_the_node_and_its_errors_are_located() -> None:
    tree = load('<A name="a"/>', nodes={"A": recording(S)})
    tree.setup(node="the node")
    assert leaf(tree, "a").calls == ["setup the node"]

    class NoSetup(py_trees.behaviour.Behaviour):
        def setup(self, **kwargs: Any) -> None:
            raise OSError("no camera")

        def update(self) -> PyTreesStatus:
            return S

    with pytest.raises(TickError, match=r"node 'b' .*no camera"):
        load('<B name="b"/>', nodes={"B": NoSetup}).setup()


def test_the_behaviours_own_status_follows() -> None:
    tree = load('<A name="a"/>', nodes={"A": recording(R, S)})
    seen = []
    for _ in range(2):
        tree.tick_exactly_once()
        seen.append(leaf(tree, "a").status)
    assert seen == [R, S]


def test_a_class_is_what_its_kind_says() -> None:
    for kind, leaf_class in LEAF_KINDS.items():
        tree = load("<A/>", nodes={"A": recording(PyTreesStatus.SUCCESS, kind=kind)})
        assert type(tree.nodes[0]) is leaf_class
