"""Names and texts of C++: identifiers that are valid and unique, string literals, comments."""

from __future__ import annotations

import re
import unicodedata
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

from translator.text import clean

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_KEYWORD_TEXT = """
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t
class co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue
decltype default delete do double dynamic_cast else enum explicit export extern false final float for
friend goto if import inline int long module mutable namespace new noexcept not not_eq nullptr operator
or or_eq override private protected public register reinterpret_cast requires return short signed sizeof
static static_assert static_cast struct switch template this thread_local throw true try typedef typeid
typename union unsigned using virtual void volatile wchar_t while xor xor_eq
"""
_KEYWORDS = frozenset(_KEYWORD_TEXT.split())
# Namespaces that the code uses, and macros of other systems' headers.
_TAKEN_TEXT = """
BT std TRUE FALSE DEBUG ERROR DOMAIN OVERFLOW UNDERFLOW IN OUT CONST DELETE interface near far small min
max major minor signals slots emit main
"""
_TAKEN = frozenset(_TAKEN_TEXT.split())
# Members of BehaviorTree.CPP's nodes: a class of that name would hide them.
_MEMBER_TEXT = """
tick halt haltNode onStart onRunning onHalted providedPorts name status config type executeTick getInput
setOutput getLockedPortContent getRawPortValue UID fullPath registrationName child children
childrenCount addChild setChild haltChild haltChildren resetChild resetChildren resetStatus setStatus
emitWakeUpSignal isHaltRequested requestsWakeUp parseString wakeUp isHalted subscribeToStatusChange
modifyPortsRemapping child_node_ children_nodes_ Ptr PreScripts PostScripts StatusChangeSignal
StatusChangeSubscriber StatusChangeCallback PreTickCallback PostTickCallback TickMonitorCallback
waitValidStatus getInputStamped requiresWakeUp checkPreConditions checkPostConditions setRegistrationID
setWakeUpInstance setPreTickFunction setPostTickFunction setTickMonitorCallback isBlackboardPointer
getRemappedKey stripBlackboardPointer PImpl parseStringWithConverter postConditionsScripts
preConditionsScripts TreeNode LeafNode ActionNodeBase SyncActionNode StatefulActionNode ConditionNode
ControlNode DecoratorNode NodeConfig
"""
_MEMBERS = frozenset(_MEMBER_TEXT.split())


@cache
def macros() -> frozenset[str]:
    """Returns the names that are macros in the headers that nodes include."""
    lines = resources.files("translator.cpp").joinpath("macros.txt").read_text(encoding="utf-8").splitlines()
    return frozenset(line for line in lines if not line.startswith("#"))


def identifier(text: str) -> str:
    """Returns a valid name in C++ that resembles the text; different texts may give the same one.

    Letters lose their accents, others become `u` and their number; double and outer underscores, which C++
    reserves, go.
    """
    plain = unicodedata.normalize("NFKD", text)
    letters = "".join(_letter(each) for each in plain if not unicodedata.combining(each))
    name = re.sub("_+", "_", letters).strip("_") or "unnamed"
    if name[0].isdigit():
        name = f"n{name}"
    return f"{name}_" if name in _KEYWORDS or name in _TAKEN or name in macros() else name


def _letter(character: str) -> str:
    if character.isascii():
        return character if character.isalnum() else "_"
    return f"u{ord(character):04x}" if character.isalnum() else "_"


def class_name(text: str) -> str:
    """Returns the name of a node's class."""
    name = identifier(text)
    return f"{name}_" if name in _MEMBERS else name


def file_name(name: str) -> str:
    """Returns the name of the files of a class, without an ending: `check_obstacle` for `CheckObstacle`."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def unique(name: str, taken: set[str]) -> str:
    """Returns the name, with a number if it is taken, and takes it."""
    found, number = name, 1
    while found in taken:
        number += 1
        found = f"{name.rstrip('_')}_{number}"
    taken.add(found)
    return found


def literal(text: str) -> str:
    """Returns a string literal in one line; invisible characters become escapes."""
    return f'"{"".join(_escaped(each) for each in clean(text))}"'


def _escaped(character: str) -> str:
    if character in {'"', "\\", "?"}:  # ?? begins a trigraph
        return f"\\{character}"
    if character.isprintable():
        return character
    # Always three digits, so that digits after them are not part of the escape.
    return "".join(f"\\{byte:03o}" for byte in character.encode())


def comment_lines(text: str) -> Iterator[str]:
    """Yields the lines of a text for a comment between `/*` and `*/`, which they cannot end."""
    for line in clean(text).expandtabs(4).splitlines():
        shown = "".join(each if each.isprintable() else "\ufffd" for each in line.rstrip())
        yield re.sub(r"(?<=\*)(?=/)|(?<=/)(?=\*)", " ", shown)


def one_line(texts: Iterable[str]) -> str:
    """Returns texts as one line for a comment after `//`; the line cannot continue on the next."""
    joined = " ".join(" ".join(comment_lines(text)) for text in texts)
    return re.sub(r"\\$", "\\\\.", joined)
