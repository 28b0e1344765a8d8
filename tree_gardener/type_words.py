"""The names of types in messages, in words: those of ``catalog.json`` are those of C++."""

from __future__ import annotations

from typing import Final

TYPE_WORDS: Final = {
    "int": "a whole number",
    "uint": "a whole number, 0 or more",
    "int64": "a whole number of 64 bits",
    "double": "a number",
    "bool": "true or false",
    "status": "SUCCESS, FAILURE, SKIPPED or RUNNING",
    "string": "a text",
    "script": "a script",
    "any": "a value",
}


def type_words(name: str) -> str:
    """Returns what a type holds, in words: ``a whole number``; ``a value of type Spot`` for other types.

    Args:
        name: as in ``catalog.json``: ``double``, ``list[int]``; a Python class by its name.
    """
    if name.startswith("list[") and name.endswith("]"):
        return f"a list, each {type_words(name[5:-1])}"
    return TYPE_WORDS.get(name) or f"a value of type {name}"
