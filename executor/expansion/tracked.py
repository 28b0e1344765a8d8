"""Xacro whose elements know the file and the line that they come from.

Xacro keeps no places: its errors name at most a file, and the lines of its output are others. Here the parser
notes the place of each element, copies keep it, and the last element that was looked at is the place of an
error.
"""

from __future__ import annotations

import contextlib
import io
import os
import xml.dom.minidom as dom
import xml.parsers.expat
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.dom import expatbuilder

import xacro
from xacro import substitution_args

from tree_gardener.packages import MissingPackageError, PackageError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tree_gardener.packages import Packages

DEEPEST = 32


class Place(NamedTuple):
    """A line of a file; lines count from 1."""

    file: str
    line: int


class ExpansionError(Exception):
    """The macros are wrong; `place` is where."""

    def __init__(self, message: str, place: Place) -> None:
        super().__init__(message)
        self.place = place


class Expanded(NamedTuple):
    """An expanded document, and the place that each of its lines comes from."""

    text: str
    places: list[Place]


class _Tracker:
    """The packages that are known, the places of elements, and the element that was looked at last."""

    def __init__(self, file: Path, packages: Packages, *, is_lenient: bool) -> None:
        self.packages = packages
        self.is_lenient = is_lenient
        self.missing: list[str] = []
        self.last = Place(str(file), 1)
        self.found: dict[str, str] = {}

    def look(self, node: Any) -> None:
        place = getattr(node, "place", None)
        if place is not None:
            self.last = place

    def lacks(self, include: Any, symbols: Any) -> bool:
        """Returns whether an `<xacro:include>` names a package that nobody has, and may be left out."""
        if not self.is_lenient:
            return False
        try:
            xacro.eval_text(include.getAttribute("filename"), symbols)
        except Exception as error:
            if isinstance(_cause(error), MissingPackageError):
                where = f"{self.last.file.rsplit('/', 1)[-1]}:{self.last.line}"
                self.missing.append(f"{where}: the include is left out: {_cause(error)}")
                return True
        return False

    def find(self, name: str) -> str:
        """Returns the folder of a package: what `$(find NAME)` stands for."""
        folder = str(self.packages.folder(name))
        self.found[folder] = name
        return folder

    def parse(self, source: Any, filename: str | None = None) -> Any:
        """Is `xacro.parse`: returns the document of a file, with a place at each element."""
        if source is not None:
            return source
        shown = str(self.packages.in_source(Path(os.path.abspath(str(filename)))))  # noqa: PTH100 - keeps links
        if xacro.filestack and xacro.filestack[-1] == filename:
            xacro.filestack[-1] = shown  # what it includes lies beside it
        stack: list[str] = xacro.filestack or []
        if shown in stack[:-1]:
            raise xacro.XacroException(f"{shown.rsplit('/', 1)[-1]} includes itself")
        if len(stack) > DEEPEST:
            raise xacro.XacroException(f"files include each other more than {DEEPEST} levels deep")
        try:
            with open(shown, "rb") as file:  # noqa: PTH123 - the path may be no string of a path's
                data = file.read()
        except OSError as error:
            stack.pop()
            text = f"the file {shown.rsplit('/', 1)[-1]} cannot be read: {error.strerror}"
            raise xacro.XacroException(text, exc=error) from error
        if b"<!DOCTYPE" in data:
            raise ExpansionError("xacro needs no DOCTYPE", Place(shown, 1))
        try:
            return _Builder(shown).parseFile(io.BytesIO(data))
        except xml.parsers.expat.ExpatError as error:
            text = xml.parsers.expat.errors.messages.get(error.code, "not well-formed")
            raise ExpansionError(text, Place(shown, error.lineno)) from error


class _Builder(expatbuilder.ExpatBuilderNS):
    def __init__(self, file: str) -> None:
        super().__init__()
        self._file = file

    def start_element_handler(self, name: str, attributes: Any) -> None:
        super().start_element_handler(name, attributes)
        element: Any = self.curNode
        element.place = Place(self._file, self.getParser().CurrentLineNumber)


def expand(
    file: Path, packages: Packages, arguments: dict[str, str], *, is_lenient: bool = False
) -> Expanded:
    """Returns the expanded document of a file.

    Args:
        file: the file.
        packages: the packages that it may name; their notes get what is left out.
        arguments: values of the arguments of macros.
        is_lenient: whether to leave out an include of a package that nobody has.

    Raises:
        ExpansionError: the macros are wrong.
    """
    tracker = _Tracker(file, packages, is_lenient=is_lenient)
    with _patched(tracker):
        try:
            xacro.init_stacks(str(file))
            document = tracker.parse(None, str(file))
            xacro.process_doc(document, mappings=dict(arguments))
        except ExpansionError:
            raise
        except Exception as error:  # xacro evaluates expressions of users, which may raise anything
            if isinstance(_cause(error), MemoryError):
                raise MemoryError from error
            text = "; ".join([_in_words(error), *tracker.missing])
            raise ExpansionError(text, tracker.last) from error
    packages.notes += tracker.missing
    _name_packages(document, tracker.found)
    text = document.toprettyxml(indent="  ")
    return Expanded(text, _places(document, text))


@contextlib.contextmanager
def _patched(tracker: _Tracker) -> Iterator[None]:
    """Replaces the functions of xacro that read files, find packages and look at elements."""
    copy = dom._clone_node  # type: ignore[attr-defined]

    def clone(node: Any, *rest: Any) -> Any:
        made = copy(node, *rest)
        if hasattr(node, "place"):
            made.place = node.place
        return made

    def looking(inner: Callable[..., Any]) -> Callable[..., Any]:
        def outer(node: Any, *rest: Any, **named: Any) -> Any:
            tracker.look(node)
            return inner(node, *rest, **named)

        return outer

    include = xacro.process_include

    def including(element: Any, macros: Any, symbols: Any, func: Any) -> None:
        tracker.look(element)
        if tracker.lacks(element, symbols):
            xacro.replace_node(element, by=None)
        else:
            include(element, macros, symbols, func)

    names = ("eval_all", "check_attrs", "reqd_attrs", "handle_macro_call")
    places = [(xacro, name, looking(getattr(xacro, name))) for name in names]
    places += [
        (xacro, "process_include", including),
        (xacro, "parse", tracker.parse),
        (dom, "_clone_node", clone),
    ]
    places += [(substitution_args, "_eval_find", tracker.find)]
    symbols: dict[str, Any] = substitution_args._eval_dict
    before = [(module, name, getattr(module, name)) for module, name, _ in places]
    found = symbols["find"]
    try:
        for module, name, made in places:
            setattr(module, name, made)
        symbols["find"] = tracker.find
        yield
    finally:
        for module, name, made in before:
            setattr(module, name, made)
        symbols["find"] = found


def _name_packages(document: Any, found: dict[str, str]) -> None:
    """Writes `package://NAME` in place of the folder of a package, which is another one on each machine."""
    for element in document.getElementsByTagName("*"):
        name = element.getAttribute("filename").removeprefix("file://")
        for folder, package in found.items():
            if name.startswith(f"{folder}/"):
                element.setAttribute("filename", f"package://{package}{name.removeprefix(folder)}")


def _places(document: Any, text: str) -> list[Place]:
    """Returns the place that each line of the output comes from: that of the last element before its end."""
    elements = iter([document.documentElement, *document.documentElement.getElementsByTagName("*")])
    places: dict[int, Place] = {}
    parser = xml.parsers.expat.ParserCreate()

    def start(_: str, __: Any) -> None:
        place = getattr(next(elements), "place", None)
        if place is not None:
            places.setdefault(parser.CurrentLineNumber, place)

    parser.StartElementHandler = start
    parser.Parse(text.encode(), True)  # noqa: FBT003 - its only form
    last = getattr(document.documentElement, "place", Place("", 1))
    found = []
    for line in range(1, text.count("\n") + 2):
        last = places.get(line, last)
        found.append(last)
    return found


def _cause(error: BaseException) -> Any:
    """Returns the exception that xacro's exceptions are about."""
    cause: Any = error
    while isinstance(getattr(cause, "exc", None), BaseException):
        cause = cause.exc
    return cause


def _in_words(error: BaseException) -> str:
    cause = _cause(error)
    if isinstance(cause, RecursionError):
        return "the macros call each other without end"
    if isinstance(cause, PackageError):
        return str(cause)
    if isinstance(cause, substitution_args.ArgException):
        return f"there is no argument {cause}: <xacro:arg> gives it a default"
    if isinstance(cause, substitution_args.SubstitutionException) and "environment variable" in str(cause):
        return f"{cause}: $(optenv NAME DEFAULT) has a default"
    if isinstance(cause, OSError):
        own = error.args[0] if error.args and isinstance(error.args[0], str) else ""
        return own or f"the file {str(cause.filename).rsplit('/', 1)[-1]} cannot be read: {cause.strerror}"
    text = " ".join(str(error).split()) or type(error).__name__
    names = ", ".join(
        str(macro.body.getAttribute("name") if getattr(macro, "body", None) else macro)
        for macro in getattr(error, "macros", None) or ()
    )
    return text + (f" (in {names})" if names else "")
