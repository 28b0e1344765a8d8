"""The script language of BehaviorTree.CPP: lexer, parser and evaluator, all with positions.

`parse` returns the syntax tree, for checks while a user types; `compile_script` returns a script that runs.
"""

from tree_gardener.errors import ScriptError
from tree_gardener.script.evaluator import Environment, Script, compile_script
from tree_gardener.script.parser import parse
from tree_gardener.script.syntax import Program, names_read, names_written

__all__ = [
    "Environment",
    "Program",
    "Script",
    "ScriptError",
    "compile_script",
    "names_read",
    "names_written",
    "parse",
]
