"""Runs a Python file that builds a tree of py_trees, and describes the tree. It runs in the child.

Each behaviour is described by its class, by the arguments with which it was made, as Python writes them, and
by its children. Arguments that are no plain values have no description.
"""

from __future__ import annotations

import enum
import importlib.util
import inspect
import math
import sys
import sysconfig
import traceback
from pathlib import Path
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING, Any, Final

from py_trees import behaviour as behaviours
from py_trees.behaviour import Behaviour
from py_trees.common import ComparisonExpression
from py_trees.composites import Composite
from py_trees.decorators import Decorator
from py_trees.trees import BehaviourTree

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

_MADE_WITH: Final = "_bt_studio_made_with"
_ITEMS: Final = 1000
_CHARACTERS: Final = 10_000
MOST: Final = 10_000
"""The behaviours that a tree may have."""


class BuildError(Exception):
    """The file builds no tree, or several, which are then in `choices`."""

    def __init__(self, message: str, file: str, line: int = 1, choices: Sequence[str] = ()) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.choices = list(choices)


def build(file: Path, main: str) -> dict[str, Any]:
    """Runs a file and describes the tree that it builds.

    Args:
        file: the file.
        main: the variable or the function with the tree; "" if it is to be found.

    Raises:
        BuildError: the file fails, or builds no tree, or several.
    """
    note_arguments()
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(file.parent))
    module = _run(file)
    expression, root = _found(module, file, main)
    others = sorted({path.relative_to(file.parent).as_posix() for path in (*loaded_beside(file), file)})
    count = sum(1 for _ in root.iterate())
    if count > MOST:
        raise BuildError(f"the tree has {count} behaviours; {MOST} are allowed", str(file))
    return {"module": module.__name__, "expression": expression, "files": others, "root": describe(root)}


def loaded_beside(file: Path) -> Iterator[Path]:
    """Yields the files of modules that were loaded from the file's folder; an environment may lie in it."""
    installed = {Path(path).resolve() for path in (sys.prefix, *sysconfig.get_paths().values())}
    for each in list(sys.modules.values()):
        if path := getattr(each, "__file__", None):
            real = Path(path).resolve()
            if file.parent in real.parents and installed.isdisjoint(real.parents):
                yield real


def note_arguments() -> None:
    """Makes each behaviour keep the arguments with which it is made."""

    def make(cls: type, *arguments: Any, **named: Any) -> Any:
        made: Any = object.__new__(cls)
        vars(made)[_MADE_WITH] = (arguments, named)
        return made

    behaviours.Behaviour.__new__ = make


def _run(file: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(file.stem, file)
    assert spec is not None and spec.loader is not None  # noqa: PT018, S101 - it is a file
    module = importlib.util.module_from_spec(spec)
    sys.modules[file.stem] = module
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise _failed(error, file) from None
    return module


def _failed(error: BaseException, file: Path) -> BuildError:
    own = [
        frame
        for frame in traceback.extract_tb(error.__traceback__)
        if file.parent in Path(frame.filename).resolve().parents
    ]
    place = (own[-1].filename, own[-1].lineno or 1) if own else (str(file), getattr(error, "lineno", 1) or 1)
    return BuildError(f"{type(error).__name__}: {error}", *place)


def _found(module: ModuleType, file: Path, main: str) -> tuple[str, Behaviour]:
    """Returns the Python expression that gives the root, and the root."""
    if main:
        if not hasattr(module, main):
            raise BuildError(f"it has no '{main}'", str(file))
        root = _root_of(main, getattr(module, main), file)
        if root is None:
            raise BuildError(f"'{main}' is no behaviour, no tree, and no function that makes one", str(file))
        return root
    values = {name: value for name, value in vars(module).items() if not name.startswith("__")}
    trees = {name: value for name, value in values.items() if isinstance(value, BehaviourTree)}
    roots = {
        name: value for name, value in values.items() if isinstance(value, Behaviour) and value.parent is None
    }
    functions = {
        name: value
        for name, value in values.items()
        if isinstance(value, FunctionType)
        and value.__module__ == module.__name__
        and ("tree" in name or "root" in name)
        and not any(
            each.default is each.empty and each.kind not in (each.VAR_POSITIONAL, each.VAR_KEYWORD)
            for each in inspect.signature(value).parameters.values()
        )
    }
    for group in (trees, roots, functions):
        found = [each for name, value in group.items() if (each := _root_of(name, value, file)) is not None]
        if len({id(root) for _, root in found}) == 1:
            return found[0]
        if found:
            names = [name.removesuffix(".root").removesuffix("()") for name, _ in found]
            text = f"it has several trees: {', '.join(names)} (name one with --main)"
            raise BuildError(text, str(file), choices=names)
    raise BuildError(
        "it makes no tree of py_trees, in a variable or by a function without arguments", str(file)
    )


def _root_of(name: str, value: Any, file: Path) -> tuple[str, Behaviour] | None:
    if isinstance(value, FunctionType):
        try:
            name, value = f"{name}()", value()
        except (Exception, SystemExit) as error:
            raise _failed(error, file) from None
    if isinstance(value, BehaviourTree):
        return f"{name}.root", value.root
    return (name, value) if isinstance(value, Behaviour) else None


def describe(behaviour: Behaviour) -> dict[str, Any]:
    """Describes a behaviour and all below it."""
    cls = type(behaviour)
    module = sys.modules.get(cls.__module__)
    kind = "composite" if isinstance(behaviour, Composite) else "leaf"
    return {
        "module": cls.__module__ if getattr(module, cls.__name__, None) is cls else "",
        "class": cls.__name__,
        "kind": "decorator" if isinstance(behaviour, Decorator) else kind,
        "name": str(behaviour.name),
        "arguments": _arguments(behaviour),
        "children": [describe(child) for child in behaviour.children],
    }


def _arguments(behaviour: Behaviour) -> dict[str, str] | None:
    """Returns the arguments with which a behaviour was made, without name and children."""
    positional, named = vars(behaviour).get(_MADE_WITH, ((), {}))
    try:
        bound = inspect.signature(type(behaviour).__init__).bind(behaviour, *positional, **named)
    except (TypeError, ValueError):
        return None
    texts: dict[str, str] = {}
    for name, value in list(bound.arguments.items())[1:]:
        kind = bound.signature.parameters[name].kind
        if kind is inspect.Parameter.VAR_KEYWORD:
            given = value
        elif kind in (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.POSITIONAL_ONLY):
            return None
        else:
            given = {name: value}
        for each, item in given.items():
            if each not in ("name", "child", "children"):
                text = _text(item, 4)
                if text is None:
                    return None
                texts[each] = text
    return texts


def _text(value: Any, depth: int) -> str | None:  # noqa: PLR0911 - one for each kind of value
    """Returns a plain value as Python writes it; None for others."""
    kind = type(value)
    if value is None or kind in (bool, int) or (kind is float and math.isfinite(value)):
        return repr(value)
    if kind in (str, bytes):
        return repr(value) if len(value) <= _CHARACTERS else None
    if isinstance(value, enum.Enum) and kind.__module__.startswith("py_trees."):
        return f"{kind.__module__}.{kind.__qualname__}.{value.name}"
    if getattr(value, "__module__", "") == "_operator":
        return f"operator.{value.__name__}"
    if not depth:
        return None
    if kind is ComparisonExpression:
        held = value.value_generator
        if getattr(held, "__qualname__", "").startswith("ComparisonExpression."):
            held = held()  # a plain value, which py_trees wrapped
        parts = [_text(each, depth - 1) for each in (value.variable, held, value.operator)]
        return _joined("py_trees.common.ComparisonExpression(", parts, ")")
    if kind.__module__ == "py_trees.common" and kind.__qualname__.startswith("ParallelPolicy.SuccessOn"):
        taken = inspect.signature(kind.__init__).parameters
        items = {name: _text(each, depth - 1) for name, each in vars(value).items() if name in taken}
        parts = [None if text is None else f"{name}={text}" for name, text in items.items()]
        return _joined(f"py_trees.common.{kind.__qualname__}(", parts, ")")
    if kind in (list, tuple, set) and 0 < len(value) <= _ITEMS:
        opening, closing = ("[", "]") if kind is list else ("{", "}") if kind is set else ("(", ",)")
        return _joined(opening, [_text(each, depth - 1) for each in value], closing)
    if kind in (list, tuple, dict) and not value:
        return repr(value)
    if kind is dict and len(value) <= _ITEMS:
        pairs = [(_text(key, 0), _text(each, depth - 1)) for key, each in value.items()]
        return _joined("{", [None if None in pair else ": ".join(map(str, pair)) for pair in pairs], "}")
    return None


def _joined(opening: str, parts: list[str | None], closing: str) -> str | None:
    texts = [part for part in parts if part is not None]
    return f"{opening}{', '.join(texts)}{closing}" if len(texts) == len(parts) else None
