"""Compiles the sources of actions into classes, from a folder or from a document's ``<Code>``."""

import importlib.abc
import importlib.machinery
import linecache
import pathlib
import sys
import types
from collections.abc import Iterable, Mapping
from typing import Any, Final

from tree_gardener import tree_tools
from tree_gardener.errors import Diagnostic, LoadError, describe
from tree_gardener.ros_fields import check_fields

PACKAGE: Final = "actions"


def load_actions(
    sources: Mapping[str, str] | str | pathlib.Path,
    *,
    only: Iterable[str] | None = None,
    keep: Iterable[str] = (),
) -> dict[str, type[Any]]:
    """Runs the sources of actions and returns their classes by name.

    Each source is compiled as ``actions/<Name>.py``, wherever it came from, so that tracebacks name the file
    that the user knows. A source of a folder may import its neighbours as ``actions.<Name>`` or by their bare
    name.

    Args:
        sources: Python source by action, or a folder with one ``<Name>.py`` for each action.
        only: the actions to load; the others run only if one of these imports them. All if None.
        keep: the actions that are loaded already and have not changed (`tree_gardener.action_changes`); their
            modules and classes stay.

    Raises:
        LoadError: a source does not compile, raises when it runs, or has no class of its name.
    """
    if not isinstance(sources, Mapping):
        folder = pathlib.Path(sources)
        sources = {
            path.stem: path.read_text(encoding="utf-8")
            for path in sorted(folder.glob("*.py"))
            if path.stem != "__init__"
        }
    tree_tools.install()
    check_fields()  # an action may make messages while it is loaded
    loader = _Loader(sources, frozenset(keep))
    classes = {}
    problems = []
    for name in sources if only is None else only:
        try:
            classes[name] = loader.load(name)
        except LoadError as error:
            problems += error.diagnostics
    if problems:
        raise LoadError(problems)
    return classes


class _Loader(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Loads actions that may import one another, by ``actions.<Name>`` or by the bare name."""

    def __init__(self, sources: Mapping[str, str], keep: frozenset[str]) -> None:
        self.sources = sources
        self.package = types.ModuleType(PACKAGE)
        self.package.__path__ = []
        for name in keep:
            module = sys.modules.get(f"{PACKAGE}.{name}")
            if module is not None:
                setattr(self.package, name, module)
        sys.modules[PACKAGE] = self.package
        # Only one set of actions can be imported at a time: that of the running program.
        earlier = [finder for finder in sys.meta_path if isinstance(finder, _Loader)]
        for name in {*sources, *(name for finder in earlier for name in finder.sources)} - keep:
            own = f"{PACKAGE}.{name}"
            sys.modules.pop(own, None)
            if getattr(sys.modules.get(name), "__name__", "") == own:  # imported by its bare name
                del sys.modules[name]
        sys.meta_path[:] = [self, *(finder for finder in sys.meta_path if finder not in earlier)]

    def find_spec(
        self, fullname: str, path: object = None, target: object = None
    ) -> importlib.machinery.ModuleSpec | None:
        """Finds the module specification of an action, for imports; None for other modules."""
        name = fullname.removeprefix(f"{PACKAGE}.")
        if name not in self.sources or (name == fullname and self.is_elsewhere(name)):
            return None
        return importlib.machinery.ModuleSpec(fullname, self)

    def is_elsewhere(self, name: str) -> bool:
        """Returns whether a bare name is that of another module, which goes first.

        The file of the action itself does not count: where its folder is in Python's path, it would run a
        second time, with classes that are not those of the tree.
        """
        for finder in sys.meta_path:
            spec = None if finder is self else finder.find_spec(name, None)
            if spec is not None:
                return pathlib.Path(spec.origin or "").parent.name != PACKAGE
        return False

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> types.ModuleType:
        """Returns the module of an action, for imports; both names give the same module."""
        name = spec.name.removeprefix(f"{PACKAGE}.")
        return sys.modules.get(f"{PACKAGE}.{name}") or self.execute(name)

    def exec_module(self, module: types.ModuleType) -> None:
        """Does nothing, since `create_module` has already run the source."""

    def load(self, name: str) -> type[Any]:
        """Returns the class of an action; runs its source, unless an import has run it already."""
        module = sys.modules.get(f"{PACKAGE}.{name}") or self.execute(name)
        cls = getattr(module, name, None)
        if not isinstance(cls, type):
            hint = f"write: class {name}(py_trees.behaviour.Behaviour)"
            raise LoadError([_problem(name, "TG611", f"actions/{name}.py has no class {name}", hint)])
        return cls

    def execute(self, name: str) -> types.ModuleType:
        """Compiles and runs one source; returns its module."""
        filename, source = f"{PACKAGE}/{name}.py", self.sources[name]
        module = types.ModuleType(f"{PACKAGE}.{name}")
        module.__file__, module.__package__ = filename, PACKAGE
        # The file need not exist: tracebacks and debuggers get the lines from here.
        linecache.cache[filename] = (len(source), None, source.splitlines(keepends=True), filename)
        try:
            code = compile(source, filename, "exec")
        except (SyntaxError, ValueError) as error:
            line, column = getattr(error, "lineno", 0) or 0, getattr(error, "offset", 0) or 0
            message = getattr(error, "msg", None) or str(error)
            raise LoadError(
                [_problem(name, "TG612", f"Python cannot read it: {message}", "", line, column)]
            ) from None
        sys.modules[module.__name__] = module
        setattr(self.package, name, module)
        try:
            exec(code, module.__dict__)  # noqa: S102 - running the user's actions is what this is for
        except LoadError:
            raise  # the error of an action that this one imports
        except (Exception, SystemExit) as error:
            del sys.modules[module.__name__]
            raise LoadError([_raised(name, filename, error)]) from error
        return module


def _problem(  # noqa: PLR0913 - one diagnostic
    name: str, code: str, message: str, hint: str, line: int = 1, column: int = 1
) -> Diagnostic:
    return Diagnostic(code, message, hint, file=f"{PACKAGE}/{name}.py", line=line, column=column, node=name)


def _raised(name: str, filename: str, error: Exception | SystemExit) -> Diagnostic:
    line, trace = 0, error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == filename:
            line = trace.tb_lineno
        trace = trace.tb_next
    hint = ""
    if isinstance(error, ModuleNotFoundError):
        hint = f"install the package that provides '{error.name}', or correct the import"
    return _problem(name, "TG613", describe(error), hint, line)
