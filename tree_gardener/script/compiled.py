"""Compiled scripts: Python functions without arguments, one for each place where a script runs.

`bind_run` and `bind_test` return a function that runs a script in its environment. Places with the same
script share the code, which is freed with the last function. Scripts beyond the limits of `generator`, and
blackboards that find entries in another way, use the evaluator.
"""

import ast
import types
import weakref
from collections.abc import Callable, Mapping
from threading import Lock
from typing import Any, Final

from tree_gardener.blackboard import Blackboard
from tree_gardener.script.environment import Environment
from tree_gardener.script.evaluator import Script, compile_script
from tree_gardener.script.generator import Generator, TooLargeError
from tree_gardener.script.writer import BOUND

ATTEMPTS: Final = 3
COMPILES = True
"""Whether scripts are compiled; tests and benchmarks switch it off to compare with the evaluator."""
_FILE: Final = f"{__file__.rpartition('/')[0]}/<script>"  # in the package, so that errors do not point to it


class Code:
    """The code of a script and the values of its parameters."""

    __slots__ = ("__weakref__", "code", "parameters")

    def __init__(self, code: types.CodeType, parameters: Mapping[str, Any]) -> None:
        self.code = code
        self.parameters = tuple(parameters.items())

    def bind(self, environment: Environment) -> Callable[[], Any]:
        """Makes the function that runs in an environment."""
        values = [BOUND[name](environment) if name in BOUND else value for name, value in self.parameters]
        # The last parameter keeps this object alive, which other functions of the same script share.
        return types.FunctionType(self.code, {"__builtins__": {}}, "script", (*values, self))


_lock: Final = Lock()
_codes: Final[weakref.WeakValueDictionary[Any, Code]] = weakref.WeakValueDictionary()


def bind_run(text: str, environment: Environment) -> Callable[[], Any]:
    """Returns a function that runs a script and returns its value.

    Raises:
        ScriptError: the script cannot be parsed.
    """
    script = compile_script(text)
    code = _code(script, environment, is_condition=False)
    return _interpreted(script.run, environment) if code is None else code.bind(environment)


def bind_test(text: str, environment: Environment) -> Callable[[], bool]:
    """Returns a function that runs a script as a condition.

    Raises:
        ScriptError: the script cannot be parsed.
    """
    script = compile_script(text)
    code = _code(script, environment, is_condition=True)
    return _interpreted(script.test, environment) if code is None else code.bind(environment)


def generated_source(text: str, enums: Mapping[str, int] | None = None, *, is_condition: bool = False) -> str:
    """Returns the generated Python of a script, for inspection; "" if the evaluator runs it.

    Raises:
        ScriptError: the script cannot be parsed.
    """
    generator = Generator(compile_script(text).program, enums or {})
    try:
        return ast.unparse(generator.function(is_condition=is_condition))
    except TooLargeError:
        return ""


def _interpreted(run: Callable[[Environment], Any], environment: Environment) -> Callable[[], Any]:
    return lambda: run(environment)


def _code(script: Script, environment: Environment, *, is_condition: bool) -> Code | None:
    if not COMPILES or type(environment.board).find is not Blackboard.find:
        return None
    enums = environment.enums
    if any(type(number) is not int for number in enums.values()):
        return None
    key = (script.text, is_condition, frozenset(enums.items()))
    code = _codes.get(key)
    if code is None:
        code = _generate(script, enums, is_condition=is_condition)
        if code is not None:
            _codes[key] = code
    return code


def _generate(script: Script, enums: Mapping[str, int], *, is_condition: bool) -> Code | None:
    generator = Generator(script.program, enums)
    try:
        module = generator.function(is_condition=is_condition)
        function = module.body[0]
        assert isinstance(function, ast.FunctionDef)
        function.args.args.append(ast.arg("KEPT", lineno=1, col_offset=0))
    except (TooLargeError, OverflowError):
        return None
    compiled = compile_module(module, _FILE)
    if compiled is None:
        return None
    code = next(part for part in compiled.co_consts if isinstance(part, types.CodeType))
    return Code(code, generator.parameters)


def compile_module(module: ast.Module, file: str) -> types.CodeType | None:
    """Compiles generated syntax; returns None if it is beyond the limits of Python's compiler.

    One module is compiled at a time: CPython 3.11 counts the depth of syntax for all threads together.
    """
    with _lock:
        for _ in range(ATTEMPTS):
            try:
                return compile(module, file, "exec")
            except (SystemError, RecursionError):
                continue  # another thread of the process may have parsed Python
            except (MemoryError, OverflowError, ValueError):
                return None
    return None
