"""Faults of control nodes against their contract: each names the node, the line, and what to do."""

from __future__ import annotations

import threading
from typing import Any

import pytest

from tests.tree_gardener.trees import LEAVES, document, load, recording
from tree_gardener import ControlNode, DecoratorNode, Status, TickError, Tree
from tree_gardener.actions import load_actions
from tree_gardener.controls.custom import CustomControl, CustomDecorator

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE
HEAD = "from tree_gardener import ControlNode, Status\n\n\nclass Own(ControlNode):\n    def update(self):\n"
WRONG = {
    "tick_child(5)": ("return self.tick_child(5)", "TG701", "Own has no child 5 (its children are 0 to 1)"),
    "tick_child(-1)": ("return self.tick_child(-1)", "TG701", "has no child -1"),
    "tick_child('0')": ("return self.tick_child('0')", "TG701", "has no child '0'"),
    "tick_child(True)": ("return self.tick_child(True)", "TG701", "has no child True"),
    "child_status(2)": ("return self.child_status(2)", "TG701", "has no child 2"),
    "halt_child(2)": ("self.halt_child(2)", "TG701", "has no child 2"),
    "halt_children(3)": ("self.halt_children(3)", "TG701", "has no child 3"),
    "nothing": ("self.tick_child(0)", "TG702", "returned nothing"),
    "idle": ("return Status.IDLE", "TG702", "returned <Status.IDLE"),
    "true": ("return True", "TG702", "returned True"),
    "list": ("return []", "TG702", r"returned [], which is no result of a tick"),
}


def tree_of(*lines: str, body: str = "<Running/><Running/>", head: str = HEAD, **more: Any) -> Tree:
    """A tree whose root is a control node with these lines in `update`."""
    source = head + "".join(f"        {line}\n" for line in lines)
    nodes = {**LEAVES, **load_actions({"Own": source}), **more}
    return Tree.from_xml(document(f'<Own name="own" _bts_id="n1">{body}</Own>'), nodes)


def fault(tree: Tree) -> TickError:
    with pytest.raises(TickError) as raised:
        tree.tick_exactly_once()
    return raised.value


@pytest.mark.parametrize("name", WRONG)
def test_a_fault_has_a_code_a_line_and_a_hint(name: str) -> None:
    line, code, message = WRONG[name]
    error = fault(tree_of(line))
    assert error.code == code
    assert message in str(error)
    assert (error.path, error.node_id, error.node_type) == ("own", "n1", "Own")
    assert error.file == "actions/Own.py"
    assert error.line == (5 if code == "TG702" else 6)
    assert error.hint
    assert error.hint in error.message


def test_a_child_ticked_in_the_halt_is_refused_and_the_halt_completes() -> None:
    tree = tree_of("return self.tick_child(0)", "", head=HEAD)
    tree.tick_exactly_once()
    control = tree.nodes[0]
    assert isinstance(control, CustomControl)
    control.own_halt = lambda: control.instance_behaviour.tick_child(0)
    said: list[str] = []
    tree.on_warning = lambda _, text: said.append(text)
    tree.halt()
    assert "outside of its own tick" in said[0], said
    assert all(node.status is Status.IDLE for node in tree.nodes)


class Meddling(ControlNode):
    """A child that calls another node's functions, as `call` says."""

    call: Any = None

    def update(self) -> Status:
        Meddling.call(self.tree_gardener_node.tree)
        return S


def meddled(call: Any) -> TickError:
    Meddling.call = staticmethod(call)
    body = "<Meddling><Running/></Meddling><Running/>"
    return fault(tree_of("self.tick_child(0)", "return self.tick_child(1)", body=body, Meddling=Meddling))


@pytest.mark.parametrize("method", ["tick_child", "halt_child", "halt_children"])
def test_a_call_while_a_child_is_ticked_is_refused(method: str) -> None:
    error = meddled(lambda tree: getattr(tree.nodes[0].instance_behaviour, method)(1))
    assert (error.code, error.path) == ("TG705", "own")
    assert "while a child is being ticked" in error.message


def test_a_tick_of_the_tree_within_its_tick_is_refused() -> None:
    error = meddled(lambda tree: tree.tick_exactly_once())
    assert (error.code, error.path) == ("TG705", "own")
    assert "do not tick the tree from its own nodes" in error.hint


def test_a_child_ticked_after_the_tree_was_halted_within_the_tick_is_refused() -> None:
    error = meddled(lambda tree: tree.nodes[0].stop())
    assert (error.code, error.path, error.line) == ("TG703", "own", 7)
    assert "after it was halted" in error.message


def test_calls_outside_of_the_tick_are_refused() -> None:
    tree = tree_of("return self.tick_child(0)")
    tree.tick_exactly_once()
    own = tree.nodes[0].instance_behaviour  # type: ignore[attr-defined]
    for call in (lambda: own.tick_child(0), lambda: own.halt_child(0), own.halt, own.mark_running):
        with pytest.raises(TickError, match="outside of its own tick") as raised:
            call()
        assert raised.value.code == "TG703"
        assert raised.value.file == __file__


def test_calls_from_another_thread_are_refused() -> None:
    raised: list[TickError] = []

    class Own(ControlNode):
        def update(self) -> Status:
            def tick(call: Any) -> None:
                with pytest.raises(TickError) as error:
                    call(0)
                raised.append(error.value)

            for call in (self.tick_child, self.halt_child):
                thread = threading.Thread(target=tick, args=(call,))
                thread.start()
                thread.join()
            return self.tick_child(0)

    assert load("<Own><Running/></Own>", nodes={"Own": Own}).tick_exactly_once() is R
    assert [error.code for error in raised] == ["TG704", "TG704"]
    assert "from another thread" in raised[0].message


def test_an_endless_recursion_is_an_error_of_the_node() -> None:
    error = fault(tree_of("return self.update()"))
    assert "RecursionError" in error.message
    assert (error.path, error.file, error.line) == ("own", "actions/Own.py", 6)


def test_a_childs_error_passes_and_names_the_child() -> None:
    body = "<Inverter><Raising name='bad'/></Inverter><Running/>"
    tree = tree_of("return self.tick_child(0)", body=body)
    error = fault(tree)
    assert error.path == "bad"
    assert "ValueError: out of order" in error.message
    assert [node.status.letter for node in tree.nodes] == ["I", "R", "I", "I"]


def test_a_childs_error_may_be_caught() -> None:
    lines = ("try:", "    return self.tick_child(0)", "except Exception:", "    return self.tick_child(1)")
    assert tree_of(*lines, body="<Raising/><Running/>").tick_exactly_once() is R


def test_its_own_exception_names_it_and_leaves_the_statuses() -> None:
    tree = tree_of("self.tick_child(0)", "raise ValueError('mine')")
    error = fault(tree)
    assert (error.path, error.line) == ("own", 7)
    assert [node.status.letter for node in tree.nodes] == ["I", "R", "I"]


@pytest.mark.parametrize("line", ["raise ValueError('mine')", "return None", "return self.tick_child(7)"])
def test_with_errors_as_failures_it_fails_and_its_children_are_halted(line: str) -> None:
    tree = tree_of("self.tick_child(0)", line)
    errors: list[TickError] = []
    tree.on_error = errors.append
    assert tree.tick_exactly_once() is F
    assert [error.path for error in errors] == ["own"]
    assert [node.status.letter for node in tree.nodes] == ["I", "I", "I"]


def test_sys_exit_is_an_error_of_the_node() -> None:
    error = fault(tree_of("import sys", "sys.exit(3)"))
    assert "sys.exit(3)" in error.message


def test_a_post_condition_that_raises_leaves_the_status_of_within_the_tick() -> None:
    for marks, before in ((True, R), (False, Status.IDLE)):

        class Own(DecoratorNode):
            MARKS_RUNNING = marks

            def update(self) -> Status:
                return self.tick_child()

        tree = load('<Own _post="missing += 1"><A/></Own>', nodes={"Own": Own, "A": recording(S)})
        with pytest.raises(TickError, match="missing"):
            tree.tick_exactly_once()
        assert [node.status for node in tree.nodes] == [before, S]


def test_two_errors_in_a_halt_are_both_reported() -> None:
    class Own(ControlNode):
        def update(self) -> Status:
            return self.tick_child(0)

        def halt(self) -> None:
            raise ValueError("first")

    class Stuck(ControlNode):
        def update(self) -> Status:
            return R

        def halt(self) -> None:
            raise ValueError("second")

    tree = load("<Own><Stuck><Running/></Stuck></Own>", nodes={"Own": Own, "Stuck": Stuck})
    tree.tick_exactly_once()
    said: list[str] = []
    tree.on_warning = lambda _, text: said.append(text)
    tree.halt()
    assert ["first" in said[0], "second" in said[1]] == [True, True], said
    assert all(node.status is Status.IDLE for node in tree.nodes)


def test_an_error_of_a_child_in_a_halt_leaves_the_status_as_that_of_a_built_in_node() -> None:
    class Own(ControlNode):
        def update(self) -> Status:
            return self.tick_child(0)

    class Stopping(ControlNode):
        def update(self) -> Status:
            self.tick_child(0)
            self.halt_children()
            return R

    for middle in ("Own", "Sequence"):
        body = f"<Stopping><{middle}><Running _onHalted='missing += 1'/></{middle}></Stopping>"
        tree = load(body, nodes={"Own": Own, "Stopping": Stopping})
        with pytest.raises(TickError, match="missing"):
            tree.tick_exactly_once()
        assert [node.status.letter for node in tree.nodes] == ["I", "R", "I"]


def test_observers_hooks_and_times_see_it_as_any_node() -> None:
    lines = ("self.tick_child(0)", "self.halt_children()", "return Status.SUCCESS")
    tree = tree_of(*lines)
    seen: list[Any] = []
    tree.observe(lambda changes: seen.append((dict(changes.changed), changes.flashed)), node_times=True)
    remove = tree.add_hook(after=lambda node, status: F if node.uid == 1 else None)
    assert tree.tick_exactly_once() is F
    remove()
    assert tree.tick_exactly_once() is S
    assert seen[1] == ({}, [(1, S)])


def test_kinds_and_types() -> None:
    nodes = {"Own": type("Own", (DecoratorNode,), {"update": lambda self: self.tick_child()})}
    tree = load("<Own><Running/></Own>", nodes=nodes)
    assert isinstance(tree.nodes[0], CustomDecorator)
    assert tree.nodes[0].kind == "Decorator"
    assert tree.root.name == "Own"


OWN = "from tree_gardener import ControlNode, Status\n\n\nclass Own(ControlNode):\n"


@pytest.mark.parametrize(
    ("body", "line", "message"),
    [
        ("    def update(self, again):\n        return Status.SUCCESS\n", 5, "missing 1 required positional"),
        ("    def tick(self):\n        return Status.SUCCESS\n", 5, "Own has no method update"),
        ("    update = None\n", 1, "object is not callable"),
    ],
)
def test_a_call_that_fails_names_the_class(body: str, line: int, message: str) -> None:
    error = fault(load("<Own><Running/></Own>", nodes=load_actions({"Own": OWN + body})))
    assert message in error.message
    assert (error.file, error.line) == ("actions/Own.py", line)


def test_a_child_ticked_in_setup_is_refused_once_with_its_line() -> None:
    body = "    def setup(self, **kwargs):\n        self.tick_child(0)\n"
    body += "    def shutdown(self):\n        self.tick_child(0)\n"
    tree = load("<Own><Running/></Own>", nodes=load_actions({"Own": OWN + body}))
    for call, line in ((tree.setup, 6), (tree.shutdown, 8)):
        with pytest.raises(TickError) as raised:
            call()
        error = raised.value
        assert (error.code, error.file, error.line) == ("TG703", "actions/Own.py", line)
        assert str(error).count("outside of its own tick") == 1


def test_a_class_without_update_says_so() -> None:
    error = fault(load("<Own><Running/></Own>", nodes={"Own": ControlNode}))
    assert "ControlNode has no method update" in error.message
