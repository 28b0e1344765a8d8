from __future__ import annotations

import io

import pytest

from executor.headless.debug.help import HELP
from executor.headless.debug.prompt import Prompt
from tests.tree_gardener.debugging.trees import calls, tree_of
from tree_gardener import Status, Tree
from tree_gardener.debugging import Debugger, DebuggingEnded

BODY = (
    '<Sequence name="all"><Leaf name="a.S"/>'
    '<Fallback name="try"><Leaf name="b.F"/><Leaf name="c.S"/></Fallback></Sequence>'
)


def session(*commands: str, tree: Tree | None = None, ticks: int = 1) -> tuple[Tree, str]:
    """Ticks a tree under the prompt, held before its first tick; returns it and what was printed."""
    tree = tree or tree_of(BODY)
    out = io.StringIO()
    debugger = Debugger(lambda stop: prompt.serve(stop))  # noqa: PLW0108 - made below
    prompt = Prompt(tree, debugger, lambda: 1.5, io.StringIO("\n".join((*commands, ""))), out)
    tree.debug(debugger)
    debugger.request_hold()
    for _ in range(ticks):
        tree.tick_exactly_once()
    return tree, out.getvalue()


def test_a_stop_is_printed_and_continue_continues() -> None:
    _, out = session("break b.F after", "continue", "continue")
    assert out.splitlines() == [
        "1.50 s, tick 1: #1 all [Sequence] before its tick  (a hold was requested)",
        "1: b.F in tree Main, after its tick (0 hits)",
        "1.50 s, tick 1: #4 b.F [Leaf] it returned FAILURE  (breakpoint 1 after its tick)",
    ]


@pytest.mark.parametrize(
    ("step", "where"),
    [
        ("into", "#2 a.S [Leaf] before"),
        ("s", "#2 a.S [Leaf] before"),
        ("over", "#1 all [Sequence] it returned SUCCESS"),
        ("to c.S", "#5 c.S [Leaf] before"),
    ],
)
def test_steps(step: str, where: str) -> None:
    assert where in session(step, "continue")[1]


def test_out_and_tick() -> None:
    _, out = session("to b.F", "out", "tick", "continue", ticks=2)
    assert "#3 try [Fallback] it returned SUCCESS  (step out)" in out
    assert "tick 2: #1 all [Sequence] before its tick  (one tick)" in out


def test_breakpoints_are_listed_switched_and_deleted() -> None:
    _, out = session("b a.S", "b c.S if 'false' hits 2", "off", "on", "delete 1", "delete all", "b", "c")
    assert "2: c.S in tree Main, before its tick if false from hit 2 on (0 hits)" in out
    assert "1 off: a.S in tree Main" in out
    assert out.splitlines()[-1] == "no breakpoints"


def test_values_and_the_tree_are_printed() -> None:
    _, out = session(
        "set speed := 0.5", "print speed", "p", "p nothing", "to b.F", "where", "ahead", "tree", "c"
    )
    assert out.count("speed = 0.5") == 2
    assert "there is no entry 'nothing' here" in out
    assert "  #3 try [Fallback] RUNNING" in out
    assert "\n#4 b.F\n#5 c.S\n" in out
    assert "->     #4 b.F [Leaf] IDLE" in out


def test_results_are_forced_frozen_skipped_and_released() -> None:
    tree, out = session("force a.S failure once", "force b.F success after", "forces", "release all", "c")
    assert "#2 a.S is FAILURE once" in out
    assert "#4 b.F is SUCCESS after its tick" in out
    assert "nothing is forced" in out
    tree, out = session("freeze a.S", "c")
    assert "#2 a.S is frozen" in out
    assert tree.nodes[1].status is Status.RUNNING
    tree, _ = session("to b.F", "skip c.S", "c")
    assert calls(tree, "b") == []
    tree, out = session("alone try", "c", ticks=2)
    assert "#3 try runs alone" in out
    assert len(calls(tree, "a")) == 3
    assert session("release a.S", "c")[1].count("nothing was forced there") == 1


@pytest.mark.parametrize(
    ("command", "why"),
    [
        ("fly", "'fly' is no command"),
        ("break z", "no node has the path, name or type 'z'"),
        ("break a.S if 'x := 1'", "it may only read"),
        ("break a.S hits 0", "must be 1 or more"),
        ("delete 7", "there is no breakpoint '7'"),
        ("force a.S", "write: force NODE"),
        ("force a.S running", "freeze NODE"),
        ("skip a b", "name one node"),
        ("alone all", "the root runs alone as it is"),
        ("skip all", "the root has no siblings"),
        ("set x :=", "expected"),
        ("print x y", "there is no entry 'x y'"),
        ("help fly", "'fly' is no command"),
        ("force 'a", "No closing quotation"),
    ],
)
def test_a_wrong_command_is_answered_in_one_sentence_and_the_tree_stays_held(command: str, why: str) -> None:
    _, out = session(command, "where", "continue")
    line = out.splitlines()[1]
    assert why in line
    assert "before its tick: a hold was requested" in out.splitlines()[-1]


@pytest.mark.parametrize("commands", [["quit"], []])
def test_quit_and_the_end_of_the_input_end_the_run(commands: list[str]) -> None:
    with pytest.raises(DebuggingEnded):
        session(*commands)


def test_help_lists_all_commands_and_completion_knows_nodes() -> None:
    _, out = session("help", "help b", "c")
    assert {name for name in dir(Prompt) if name.startswith("do_")} == {
        *(f"do_{name}" for name in HELP),
        "do_EOF",
    }
    for command in HELP:
        assert f"\n{command}" in out
    assert out.count("sets a breakpoint") == 2
    prompt = Prompt(tree_of(BODY), Debugger(print), lambda: 0.0)
    assert prompt.completedefault("b") == ["b.F", "before"]
    assert prompt.completenames("fr") == ["freeze"]
