"""The script language of BehaviorTree.CPP: lexer, parser, evaluator and compiler, all with positions.

`parse` returns the syntax tree, for checks while a user types; `compile_script` returns a script that the
evaluator runs on any blackboard; `bind_run` and `bind_test` return compiled functions for one scope.
"""

from tree_gardener.errors import ScriptError
from tree_gardener.script.compiled import bind_run, bind_test, generated_source
from tree_gardener.script.environment import Environment
from tree_gardener.script.evaluator import Script, compile_script
from tree_gardener.script.parser import parse
from tree_gardener.script.syntax import Program, names_read, names_written

__all__ = [
    "Environment",
    "Program",
    "Script",
    "ScriptError",
    "bind_run",
    "bind_test",
    "compile_script",
    "generated_source",
    "names_read",
    "names_written",
    "parse",
]
