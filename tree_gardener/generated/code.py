"""Compiles the functions of regions, once for each shape, and binds them to nodes.

Code is freed with the last function that uses it. A shape beyond the compiler's limits gets no code.
"""

import ast
import types
import weakref
from collections.abc import Callable, Mapping
from typing import Any, Final

from tree_gardener.generated.parts import Part, Region, Variant
from tree_gardener.generated.writer import FIXED, Meaning, Writer, meanings
from tree_gardener.script.compiled import compile_module

_FILE: Final = f"{__file__.rpartition('/')[0]}/<tick>"  # in the package, so that errors do not point to it


class Code:
    """The code of a shape.

    Attributes:
        code: the compiled function.
        parameters: for each parameter its name, if it is one of `FIXED`, or the position of its value.
        lines: the meaning of each line.
    """

    __slots__ = ("__weakref__", "code", "lines", "parameters")

    def __init__(
        self,
        code: types.CodeType,
        parameters: tuple[str | int, ...],
        lines: Mapping[int, Meaning],
    ) -> None:
        self.code = code
        self.parameters = parameters
        self.lines = lines

    def bind(self, values: list[Any], fixed: Mapping[str, Any]) -> Callable[[], Any]:
        """Makes a function of values."""
        defaults = [
            values[parameter] if isinstance(parameter, int) else fixed[parameter]
            for parameter in self.parameters
        ]
        function = types.FunctionType(self.code, {"__builtins__": {}}, "tick", tuple(defaults))
        function.__dict__["code"] = self  # kept for other functions of the shape
        return function


_codes: Final[weakref.WeakValueDictionary[Any, Code]] = weakref.WeakValueDictionary()


def code_of(region: Region, variant: Variant) -> Code | None:
    """Returns the code of a region; None if Python's compiler cannot take it."""
    shape = (region.root, variant)
    # Weak: a class that leads to its tree, as by a global of its module, would keep the code for good.
    key = (shape, tuple(weakref.ref(cls) for cls in region.classes))
    code = _codes.get(key)
    if code is not None:
        return code
    other = _codes.get(shape)
    if other is None:
        code = _generate(region.root, variant)
        if code is not None:
            _codes[shape] = code
    else:
        # Python specialises code for the classes that it meets, so other classes get a copy.
        code = Code(other.code.replace(co_name="tick"), other.parameters, other.lines)
    if code is not None:
        _codes[key] = code
    return code


def source_of(region: Region, variant: Variant) -> str:
    """Returns the source of a region's function, for inspection."""
    return ast.unparse(Writer(variant).function(region.root))


def _generate(root: Part, variant: Variant) -> Code | None:
    writer = Writer(variant)
    compiled = compile_module(writer.function(root), _FILE)
    if compiled is None:
        return None
    names = writer.parameters()
    parameters = tuple(name if name in FIXED else int(name[1:]) for name in names)
    code = next(part for part in compiled.co_consts if isinstance(part, types.CodeType))
    return Code(code, parameters, dict(meanings(root)))
