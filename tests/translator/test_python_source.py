"""Python is parsed by one thread at a time, and in one module."""

from __future__ import annotations

import ast
import gc
import re
import threading
import time
from pathlib import Path

import pytest

import translator
from translator.python_source import parse

ROOT = Path(__file__).parents[2]
SOURCE = "x = [" + ", ".join(f"f({n}, a=[1, 2])" for n in range(200)) + "]\n"


def parsed_by_threads(read, *, rounds):
    """Returns the errors when eight threads, each on another level of its stack, read the same source."""
    failures, went_wrong = [], threading.Event()

    def at_depth(depth):
        return read(SOURCE, "x.py") if depth == 0 else at_depth(depth - 1)

    def work(depth):
        for _ in range(rounds):
            if went_wrong.is_set():
                return
            try:
                at_depth(depth)
            except (SystemError, RecursionError) as error:
                failures.append(error)
                went_wrong.set()

    def let_others(*_):  # garbage is collected in the middle of a tree
        time.sleep(0)

    threads = [threading.Thread(target=work, args=(7 * n,)) for n in range(8)]
    gc.callbacks.append(let_others)
    try:
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        gc.callbacks.remove(let_others)
    return failures


def parsed_while_another_does(read, *, patience_s):
    """Parses, and in the middle waits until another thread, deeper in its stack, has parsed too."""
    begin, done = threading.Event(), threading.Event()
    reader = threading.current_thread()

    def deeper(depth):
        return read(SOURCE, "y.py") if depth == 0 else deeper(depth - 1)

    def other():
        begin.wait(60)
        deeper(20)
        done.set()

    def wait_for_other(phase, _):
        if threading.current_thread() is reader and not begin.is_set():
            begin.set()
            done.wait(patience_s)

    thread = threading.Thread(target=other)
    thread.start()
    gc.callbacks.append(wait_for_other)
    try:
        return read(SOURCE, "x.py")
    finally:
        gc.callbacks.remove(wait_for_other)
        begin.set()
        thread.join()


def test_two_threads_that_read_at_once_disturb_each_other_without_us():
    with pytest.raises(SystemError, match="recursion depth mismatch"):
        parsed_while_another_does(ast.parse, patience_s=60)


def test_one_thread_reads_at_a_time():
    assert isinstance(parsed_while_another_does(parse, patience_s=0.3), ast.Module)


def test_eight_threads_that_read_python_do_not_disturb_each_other():
    assert parsed_by_threads(parse, rounds=10) == []


def test_what_the_standard_library_disturbs_is_read_again(monkeypatch):
    read, raised = ast.parse, [SystemError("depth mismatch"), RecursionError("too deep")]

    def disturbed(*arguments, **options):
        if raised:
            raise raised.pop()
        return read(*arguments, **options)

    monkeypatch.setattr(ast, "parse", disturbed)
    assert isinstance(parse("x = 1", "x.py"), ast.Module)
    assert raised == []


def test_too_deep_nesting_is_reported_as_such():
    found = translator.inspect_action(
        "x = " + "[" * 150 + "]" * 150 + "\n" + "-" * 5000 + "1\n", "actions/Deep.py"
    )
    assert [each.code for each in found.diagnostics] == ["BT0601"]


IN_PROCESSES_OF_THEIR_OWN = {
    *("backend/language/message_stubs.py", "backend/language/rclpy_types.py"),
    *("tree_gardener/action_changes.py", "tree_gardener/actions.py", "tree_gardener/script/compiled.py"),
    "tree_gardener/ros_script.py",
}
"""Run by `python -m backend.language.library`, by the application, and as a launch node."""
OF_INSTALLED_PACKAGES = {"translator/installed_interfaces.py"}
"""No user writes what it parses."""


MAKES_TREES = re.compile(r"\b(?:parse|compile|exec|eval)\b|\bfrom ast\b")
"""In the text of every source that could."""


def test_nothing_else_in_the_web_server_makes_syntax_trees():
    found = set()
    for package in ("backend", "translator", "tree_gardener"):
        for path in (ROOT / package).rglob("*.py"):
            text = path.read_text()
            for node in ast.walk(ast.parse(text)) if MAKES_TREES.search(text) else ():
                if isinstance(node, ast.Call) and ast.unparse(node.func) in {
                    "ast.parse",
                    "compile",
                    "builtins.compile",
                    "exec",
                    "eval",
                }:
                    found.add(str(path.relative_to(ROOT)))
                if isinstance(node, ast.ImportFrom) and node.module == "ast":
                    assert not {alias.name for alias in node.names} & {"parse", "literal_eval"}, path
    assert found == IN_PROCESSES_OF_THEIR_OWN | OF_INSTALLED_PACKAGES | {"translator/python_source.py"}
    assert not any("tree_gardener.actions" in path.read_text() for path in (ROOT / "backend").rglob("*.py"))
