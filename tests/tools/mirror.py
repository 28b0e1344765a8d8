"""Lists modules without a test file of their own: `python -m tests.tools.mirror`.

The test file of `backend/projects/storage/names.py` is `tests/backend/projects/storage/test_names.py`,
that of `src/model/layout.ts` is `src/model/layout.test.ts`. It must import its module, or something of it
that a package exports, and assert something. A Python module that only declares needs none.

`unmirrored.txt` lists the modules that have none. The list only shrinks: a module that has its test file now
must leave it (`--write`), and a new module without one fails. After a move, `--write` renames the entries,
and refuses where there are more of them than before. After a merge that brings modules, delete the list
first.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path
from typing import Final

from tests.tools import shrinking
from tests.tools.sources import Import, imports_of

ROOT: Final = Path(__file__).resolve().parents[2]
LIST: Final = Path(__file__).with_name("unmirrored.txt")
PACKAGES: Final = ("backend", "executor", "translator", "tree_gardener")
PAGE: Final = "frontend/src"
# Tables and entry points without a rule of their own.
LEFT_OUT: Final = {"__init__", "__main__", "apps", "urls", "manage", "index", "main"}
FOLDERS_LEFT_OUT: Final = {"migrations", "behaviours", "setup", "generated", "locales", "test"}
# Modules below are imported by their own names: actions find them so.
ON_PATH: Final = "executor.ros_python."
# The parts of an expression without logic.
PLAIN: Final = (
    *(ast.Constant, ast.Name, ast.Attribute, ast.Tuple, ast.List, ast.Dict, ast.JoinedStr),
    *(ast.FormattedValue, ast.expr_context),
)
# Lines at the left edge that are neither exports, imports, comments, types, nor the end of one.
STATEMENTS: Final = re.compile(r"(?m)^(?!import\b|export\b|type\b|interface\b)[\w(]")
EXPORTS: Final = re.compile(r"(?m)^export (?:default )?([\w*{]+)")
ASSERTS: Final = re.compile(r"\bassert\b|\bexpect\(|pytest\.(?:raises|warns)")


def python_modules() -> list[Path]:
    """Returns the Python modules that need a test file."""
    paths = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]
    return [path for path in paths if _counts(path) and not is_declaration(path)]


def page_modules() -> list[Path]:
    """Returns the modules of the page that need a test file."""
    paths = sorted((ROOT / PAGE).rglob("*.ts*"))
    kinds = (".test.ts", ".test.tsx", ".d.ts")
    modules = (path for path in paths if _counts(path) and not path.name.endswith(kinds))
    return [path for path in modules if not declares_types_alone(path)]


def declares_types_alone(path: Path) -> bool:
    """Returns whether a module of the page exports types and nothing that runs."""
    text = path.read_text(encoding="utf-8")
    exports = set(EXPORTS.findall(text))
    return bool(exports) and exports <= {"type", "interface"} and not STATEMENTS.search(text)


def _counts(path: Path) -> bool:
    parts = path.relative_to(ROOT).parts[:-1]
    return path.stem not in LEFT_OUT and not FOLDERS_LEFT_OUT & set(parts)


def is_declaration(path: Path) -> bool:
    """Whether a Python module only declares: constants, records, protocols, tables, but no logic to test."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    loops = any(isinstance(node, ast.For | ast.While | ast.With | ast.Try) for node in tree.body)
    return not loops and all(_is_plain(statement) for function in functions for statement in function.body)


def _is_plain(statement: ast.stmt) -> bool:
    """Returns whether a statement of a function only stores or returns its arguments."""
    match statement:
        case ast.Pass() | ast.Expr(ast.Constant()) | ast.Expr(ast.Call(ast.Attribute(attr="__init__"))):
            return True
        case ast.Raise(ast.Name("NotImplementedError") | ast.Call(ast.Name("NotImplementedError"))):
            return True
        case ast.Assign(value=value) | ast.AnnAssign(value=value) | ast.Return(value=value):
            return value is None or all(isinstance(node, PLAIN) for node in ast.walk(value))
        case _:
            return False


def is_mirrored(path: Path) -> bool:
    """Whether the module has a test file that imports it and asserts."""
    if path.suffix != ".py":
        tests = (path.with_suffix(f".test{suffix}") for suffix in (".ts", ".tsx"))
        return any(test.is_file() and _imports_script(test, path.stem) for test in tests)
    relative = path.relative_to(ROOT)
    test = ROOT / "tests" / relative.with_name(f"test_{path.stem.strip('_')}.py")
    return test.is_file() and _imports_python(test, path)


def _imports_script(test: Path, stem: str) -> bool:
    text = test.read_text(encoding="utf-8")
    return bool(ASSERTS.search(text)) and re.search(rf"from '[^']*/{re.escape(stem)}'", text) is not None


def _imports_python(test: Path, module: Path) -> bool:
    text = test.read_text(encoding="utf-8")
    name = ".".join(module.relative_to(ROOT).with_suffix("").parts).removeprefix(ON_PATH)
    return bool(ASSERTS.search(text)) and any(_brings(each, name, module) for each in imports_of(text))


def _brings(found: Import, module: str, file: Path) -> bool:
    """Returns whether an import is that of a module, or of something of it, directly or through a package."""
    if found.names is None or found.module == module:
        return found.module == module
    package, _, stem = module.rpartition(".")
    is_above = module.startswith(f"{found.module}.")
    return (found.module == package and stem in found.names) or (
        is_above and bool(found.names & _defined(file))
    )


def _defined(file: Path) -> set[str]:
    found: set[str] = set()
    for node in ast.parse(file.read_text(encoding="utf-8")).body if file.is_file() else []:
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            found.add(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            found |= {target.id for target in targets if isinstance(target, ast.Name)}
    return found


def unmirrored() -> list[str]:
    """Returns the modules without a test file of their own, by path."""
    modules = [*python_modules(), *page_modules()]
    return sorted(str(path.relative_to(ROOT)) for path in modules if not is_mirrored(path))


def main(arguments: list[str]) -> int:
    """Compares, or writes the list; returns 1 where they differ."""
    return shrinking.compare(
        unmirrored(),
        LIST,
        arguments,
        new="has no test file of its own that imports it and asserts",
        gone="is gone or has its test file now; run `python -m tests.tools.mirror --write`",
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
