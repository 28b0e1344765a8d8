"""Checks of the texts that ports are given, when a tree is built and when one is changed while it runs."""

from typing import TYPE_CHECKING, NamedTuple

from tree_gardener.blackboard import Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.ports import OUTPUT, PortSpec, pointer_key
from tree_gardener.script import compile_script
from tree_gardener.type_words import type_words
from tree_gardener.values import ANY, STATUS, STRING, ConversionError

if TYPE_CHECKING:
    from tree_gardener.node import Node


class PortProblem(NamedTuple):
    """A mistake in the text of a port; `span_start` is the place of the error in a script."""

    code: str
    message: str
    hint: str = ""
    span_start: int = 0


def check_text(node_class: "type[Node]", spec: PortSpec, text: str) -> PortProblem | None:
    """Checks a literal against the type of its port."""
    if pointer_key(text, spec.name) is not None:
        is_bare = text[0] == "{" and text[-1] == "}"
        if is_bare or not spec.type.is_strong or spec.type in (STRING, STATUS):
            return None
        taken = type_words(spec.type.name)
        message = f"the port '{spec.name}' takes {taken}, and no blanks round '{text.strip()}'"
        return PortProblem("TG303", message, "remove them")
    if spec.direction == OUTPUT:
        message = f"the output port '{spec.name}' needs an entry, not '{text}'"
        problem = PortProblem("TG304", message, f"write {{{text or 'key'}}}")
        return problem if spec.type.is_strong else None
    if spec.name == node_class.CODE:
        return _check_script(spec.name, text)
    return None if spec.type is STATUS else _check_type(spec, text)


def _check_type(spec: PortSpec, text: str) -> PortProblem | None:
    try:
        spec.type.parse(text)
    except ConversionError as error:
        if text.strip()[:1] == "{":
            message = f"'{text}' opens a brace and does not close it"
            return PortProblem("TG303", message, "an entry is written {key}")
        message = f"the port '{spec.name}' takes {type_words(spec.type.name)}: {error}"
        return PortProblem("TG305", message, "write a literal of that type, or a {key}")
    return None


def _check_script(name: str, text: str) -> PortProblem | None:
    """Checks that a script parses; an empty one does nothing."""
    if not text:
        return None
    try:
        compile_script(text)
    except ScriptError as error:
        return script_problem(name, error)
    return None


def script_problem(name: str, error: ScriptError) -> PortProblem:
    """Returns the problem of a script that does not parse, at the position of the error."""
    return PortProblem("TG401", f"in the script of '{name}': {error.message}", error.hint, error.span[0])


def declare_entry(
    node_class: "type[Node]", spec: PortSpec, text: str, board: Blackboard
) -> PortProblem | None:
    """Declares the entry that a port leads to, or compares the port's type with that of the entry."""
    key = pointer_key(text, spec.name)
    if key is None:
        return None
    # Nodes that watch an entry declare it as BT::Any, which takes no strings later.
    weak = ANY if spec.name == node_class.NEEDS else None
    entry = board.find(key)
    if entry is None:
        try:
            board.create(key, spec.type if spec.type.is_strong else weak)
        except (Exception, SystemExit) as error:
            return PortProblem("TG306", str(error))
    elif (
        entry.type is not None
        and entry.type.is_strong
        and spec.type.is_strong
        and entry.type is not spec.type
        and entry.type is not STRING
    ):
        there, here = type_words(entry.type.name), type_words(spec.type.name)
        message = f"the entry '{key}' is {there} elsewhere and {here} here"
        return PortProblem("TG306", message, "use two entries, or ports of one type")
    return None
