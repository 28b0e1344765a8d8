"""Reads the launch files of an application: arguments, nodes, parameters, remappings, groups and includes.

It supports the part of ROS 2's formats (YAML and XML) that needs no `launch` package: `arg`, `let`, `node`,
`executable`, `group`, `include` and `push_ros_namespace`, with the substitutions of `substitution.py`, `if`
and `unless`. Known elements that are not supported are left out, with a note. Errors are reported with their
line. A file that another one includes is not started once more by itself.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.launching.documents import CODE, read_document
from executor.launching.find import LAUNCH_PY_REFUSAL, NotFound, find_command, find_executable, has_launch
from executor.launching.model import LaunchPlan, NodeSpec
from executor.launching.navigators import may_navigate
from executor.launching.parameters import parameter_text, parameter_value
from executor.launching.substitution import SubstitutionError, Substitutions, truth
from executor.universes.document import DocumentError, Located, Problem
from translator.package.launch_files import FOLDER, started_files

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["CODE", "MOST_INCLUDES", "MOST_NODES", "read_launch_files"]

MOST_NODES: Final = 32
MOST_INCLUDES: Final = 32
"""The largest number of includes within each other."""
_LEFT_OUT: Final = frozenset(
    {
        "append_env", "log", "node_container", "reset", "set_env", "set_parameter", "set_remap", "timer",
        "unset_env",
    }
)  # fmt: skip
_NODE_KEYS: Final = frozenset(
    {"pkg", "exec", "name", "namespace", "args", "ros_args", "param", "remap", "env", "if", "unless"}
)
_IGNORED_KEYS: Final = frozenset(
    {
        "cwd",
        "emulate_tty",
        "exec_name",
        "launch-prefix",
        "on_exit",
        "output",
        "respawn",
        "respawn_delay",
        "respawn_max_retries",
        "shell",
        "sigkill_timeout",
        "sigterm_timeout",
    }
)
_EXECUTABLE_KEYS: Final = frozenset({"cmd", "name", "env", "if", "unless"})
_GROUP_KEYS: Final = frozenset({"children", "scoped", "forwarding", "if", "unless"})
_INCLUDE_KEYS: Final = frozenset({"file", "arg", "let", "if", "unless"})
_NAMESPACE_KEYS: Final = frozenset({"namespace", "if", "unless"})
_ARG_KEYS: Final = frozenset({"name", "default", "description", "choice", "if", "unless"})
_LET_KEYS: Final = frozenset({"name", "value", "if", "unless"})
_PARAM_KEYS: Final = frozenset({"name", "value", "value-sep", "type", "param", "from", "allow_substs"})
_ENTRY_KEYS: Final = {
    "arg": frozenset({"name", "value"}),
    "let": frozenset({"name", "value"}),
    "env": frozenset({"name", "value"}),
    "remap": frozenset({"from", "to"}),
    "choice": frozenset({"value"}),
    "param": _PARAM_KEYS,
}
_MAY_BE_TRUTHS: Final = frozenset({"scoped", "forwarding"})
"""Values that `launch` reads as true and false of YAML, not as texts."""
_READ: Final = {
    "arg": "arg",
    "let": "let",
    "node": "node",
    "executable": "executable",
    "include": "include",
    "push_ros_namespace": "push_namespace",
    "push-ros-namespace": "push_namespace",
}
"""The actions that are read, and the method of each."""


def read_launch_files(root: Path) -> LaunchPlan:
    """Reads the launch files of an unpacked application, in the order of their names.

    Raises:
        DocumentError: a file cannot be read; with its place.
    """
    nodes: list[NodeSpec] = []
    notes: list[str] = []
    folder = root / FOLDER
    paths = [path for path in folder.rglob("*launch.*") if path.is_file()] if folder.is_dir() else []
    files = {path.relative_to(root).as_posix(): path.read_bytes() for path in paths}
    for name in started_files(files):
        _Reader(root, root / name, nodes, notes).read()
    return LaunchPlan(tuple(nodes), tuple(notes), str(root))


class _Reader:
    """Reads one launch file, and adds its nodes and notes to lists that all files share."""

    def __init__(self, root: Path, path: Path, nodes: list[NodeSpec], notes: list[str]) -> None:
        self._root = root
        self._nodes = nodes
        self._notes = notes
        self._variables: dict[str, str] = {}
        self._namespace = ""
        self._chain: tuple[Path, ...] = ()
        self._open(path)

    def _open(self, path: Path) -> None:
        self._path = path
        self._folder = path.parent
        self._file = path.relative_to(self._root).as_posix()
        self._document = Located(None, {})
        self._is_xml = path.suffix == ".xml"

    def read(self) -> None:
        """Reads the file, or passes one in Python on to ROS 2's own `launch`."""
        if self._path.suffix == ".py":
            self._nodes.append(self._python_launch(self._file, self._path))
            return
        self._document = read_document(self._path.read_bytes(), self._file)
        self._actions(self._document.value["launch"], ("launch",))

    def _python_launch(
        self, id_: str, path: Path, *, line: int = 1, arguments: list[str] | None = None
    ) -> NodeSpec:
        file = path.relative_to(self._root).as_posix()
        spec = NodeSpec(id_, path.name, "", file, self._file, line)
        if not has_launch():
            return replace(spec, refusal=LAUNCH_PY_REFUSAL)
        command = (sys.executable, "-m", "executor.launching.launch_py", str(path), *(arguments or ()))
        return replace(spec, command=command)

    def _actions(self, actions: list[Any], path: tuple[str | int, ...]) -> None:
        for index, action in enumerate(actions):
            here = (*path, index)
            if not isinstance(action, dict) or len(action) != 1:
                raise self._error(here, "an action is one word, such as `node:`, with its values below it")
            [(kind, value)] = action.items()
            self._action(str(kind), value, (*here, kind))

    def _action(self, kind: str, value: Any, here: tuple[str | int, ...]) -> None:
        if kind in _LEFT_OUT:
            self._note(here, f"`{kind}` is left out")
        elif kind == "group":
            self._group(value, here)
        elif kind in _READ:
            if not isinstance(value, dict):
                raise self._error(here, f"`{kind}` has values such as `name:`")
            getattr(self, f"_{_READ[kind]}")(value, here)
        else:
            raise self._error(here, f"there is no action {kind!r}", ", ".join(sorted({*_READ, "group"})))

    def _group(self, value: Any, here: tuple[str | int, ...]) -> None:
        own: dict[str, Any] = {}
        if isinstance(value, dict):
            own, value, here = value, value.get("children"), (*here, "children")
        if not isinstance(value, list):
            raise self._error(here, "`group` has a list of actions")
        self._check_keys(own, _GROUP_KEYS, here[:-1])
        if not self._is_wanted(own, here[:-1]):
            return
        is_scoped = truth(self._text(own, "scoped", here[:-1], "true"))
        outside = dict(self._variables), self._namespace
        if is_scoped and not truth(self._text(own, "forwarding", here[:-1], "true")):
            self._variables = {}
        self._actions(value, here)
        if is_scoped:
            self._variables, self._namespace = outside

    def _push_namespace(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        self._check_keys(value, _NAMESPACE_KEYS, here)
        if self._is_wanted(value, here):
            self._namespace = _joined(self._namespace, self._text(value, "namespace", here))

    def _include(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        self._check_keys(value, _INCLUDE_KEYS, here)
        if not self._is_wanted(value, here):
            return
        line, _ = self._document.place(here)
        if len(self._nodes) >= MOST_NODES:
            raise self._error(here, f"the launch files have more than {MOST_NODES} nodes")
        id_, arguments = self._id(line), self._included_arguments(value, here)
        try:
            named = self._text(value, "file", here)
        except DocumentError as error:  # a package that is not here; the node that is not started says so
            why = f"cannot be started: {error.problems[0].message}."
            self._nodes.append(NodeSpec(id_, str(value["file"]), "", "", self._file, line, refusal=why))
            return
        places = (self._root / named, self._folder / named)
        path = next((place.resolve() for place in places if place.is_file()), None)
        if path is None or not path.is_relative_to(self._root.resolve()):
            raise self._error((*here, "file"), f"there is no file {named!r} in the project")
        path = self._root / path.relative_to(self._root.resolve())
        if path.suffix == ".py":
            words = [f"{name}:={text}" for name, text in arguments.items()]
            self._nodes.append(self._python_launch(id_, path, line=line, arguments=words))
            return
        if path == self._path or path in self._chain:
            raise self._error((*here, "file"), f"{named} includes itself, here or through other files")
        if len(self._chain) >= MOST_INCLUDES:
            raise self._error(
                (*here, "file"), f"there are more than {MOST_INCLUDES} includes within each other"
            )
        self._variables |= arguments
        with self._inside(path):
            self.read()

    def _included_arguments(self, value: dict[str, Any], here: tuple[str | int, ...]) -> dict[str, str]:
        return {
            self._text(entry, "name", place): self._text(entry, "value", place)
            for key in ("arg", "let")
            for entry, place in self._entries(value, key, here)
        }

    @contextmanager
    def _inside(self, path: Path) -> Iterator[None]:
        """Reads another file; what it sets stays set after it, as in ROS 2."""
        outside = self._path, self._chain, self._document
        self._chain = (*self._chain, self._path)
        self._open(path)
        try:
            yield
        finally:
            self._open(outside[0])
            _, self._chain, self._document = outside

    def _arg(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        self._check_keys(value, _ARG_KEYS, here)
        if not self._is_wanted(value, here):
            return
        name = self._text(value, "name", here)
        if "default" in value and name not in self._variables:  # what an include gives counts
            self._variables[name] = self._text(value, "default", here)
        choices = [self._text(each, "value", place) for each, place in self._entries(value, "choice", here)]
        if choices and self._variables.get(name, choices[0]) not in choices:
            text = f"the argument {name!r} is {self._variables[name]!r}, which is not a choice"
            raise self._error(here, text, ", ".join(choices))

    def _let(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        self._check_keys(value, _LET_KEYS, here)
        if self._is_wanted(value, here):
            self._variables[self._text(value, "name", here)] = self._text(value, "value", here)

    def _node(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        self._check_keys(value, _NODE_KEYS, here)
        if not self._is_wanted(value, here):
            return
        executable = self._text(value, "exec", here)
        package = self._text(value, "pkg", here, "")
        name = self._text(value, "name", here, "")
        ros = [*self._ros_arguments(value, here, name)]
        arguments = self._words(value, "args", here)
        ros += self._words(value, "ros_args", here)
        self._add(
            here,
            name or Path(executable).stem,
            package,
            executable,
            arguments=[*arguments, *(["--ros-args", *ros] if ros else [])],
            environment=self._environment(value, here),
        )

    def _executable(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        self._check_keys(value, _EXECUTABLE_KEYS, here)
        if not self._is_wanted(value, here):
            return
        words = self._words(value, "cmd", here)
        if not words:
            raise self._error(here, "`executable` needs `cmd`")
        name = self._text(value, "name", here, "") or Path(words[0]).name
        environment = self._environment(value, here)
        self._add(here, name, None, words[0], arguments=words[1:], environment=environment)

    def _add(  # noqa: PLR0913 - what a node is
        self,
        here: tuple[str | int, ...],
        name: str,
        package: str | None,
        executable: str,
        *,
        arguments: list[str],
        environment: tuple[tuple[str, str], ...],
    ) -> None:
        if len(self._nodes) >= MOST_NODES:
            raise self._error(here, f"the launch files have more than {MOST_NODES} nodes")
        command: tuple[str, ...] = ()
        refusal = ""
        try:
            if package is None:
                command = find_executable(executable, self._root, self._folder)
            else:
                command = find_command(package, executable, self._root, self._folder)
            command = (*command, *arguments)
        except NotFound as error:
            refusal = f"cannot be started: {error}."
        line, _ = self._document.place(here)
        self._nodes.append(
            NodeSpec(
                self._id(line), name, package or "", executable, self._file, line, command,
                environment, refusal, may_navigate(package or "", command),
            )
        )  # fmt: skip

    def _id(self, line: int) -> str:
        """Returns an id by the place; several nodes may stand in one line, or a file be included twice."""
        id_, known = f"{self._file}:{line}", {node.id for node in self._nodes}
        return next(
            each for each in (id_, *(f"{id_} ({n})" for n in range(2, MOST_NODES + 2))) if each not in known
        )

    def _ros_arguments(self, value: dict[str, Any], here: tuple[str | int, ...], name: str) -> list[str]:
        words = ["-r", f"__node:={name}"] if name else []
        if namespace := _joined(self._namespace, self._text(value, "namespace", here, "")):
            words += ["-r", f"__ns:=/{namespace.strip('/')}"]
        for remap, place in self._entries(value, "remap", here):
            words += ["-r", f"{self._text(remap, 'from', place)}:={self._text(remap, 'to', place)}"]
        for param, place in self._entries(value, "param", here):
            words += self._parameter(param, place, "")
        return words

    def _parameter(self, param: dict[str, Any], here: tuple[str | int, ...], prefix: str) -> list[str]:
        given = [key for key in ("from", "value", "param") if key in param]
        if len(given) > 1 or ("from" in param and "name" in param):
            raise self._error(here, "a parameter is either `from:`, or `name:` with `value:` or `param:`")
        if "from" in param:
            return ["--params-file", self._parameter_file(param, here)]
        name = prefix + self._text(param, "name", here)
        if "param" in param:
            words: list[str] = []
            for inner, place in self._entries(param, "param", here):
                words += self._parameter(inner, place, f"{name}.")
            return words
        if "value" not in param:
            raise self._error(here, f"the parameter {name!r} has no value")
        try:
            value = parameter_value(
                param["value"],
                self._substitutions,
                type_name=self._text(param, "type", here, "yaml"),
                separator=str(param.get("value-sep", "")),
                is_xml=self._is_xml,
            )
        except SubstitutionError as error:
            raise self._error((*here, "value"), str(error)) from error
        return ["-p", self._sound(f"{name}:={parameter_text(value)}", (*here, "value"))]

    def _parameter_file(self, param: dict[str, Any], here: tuple[str | int, ...]) -> str:
        if str(param.get("allow_substs", False)).lower() not in {"false", "0"}:
            text = "substitutions in a parameter file are not read here"
            raise self._error((*here, "allow_substs"), text, "write the parameters below the node")
        name = self._text(param, "from", here)
        path = next((p for p in (self._root / name, self._folder / name) if p.is_file()), None)
        if path is None or not path.resolve().is_relative_to(self._root.resolve()):
            raise self._error((*here, "from"), f"there is no file {name!r} in the project")
        return str(path)

    def _environment(self, value: dict[str, Any], here: tuple[str | int, ...]) -> tuple[tuple[str, str], ...]:
        entries = self._entries(value, "env", here)
        return tuple((self._text(e, "name", place), self._text(e, "value", place)) for e, place in entries)

    def _entries(
        self, value: dict[str, Any], key: str, here: tuple[str | int, ...]
    ) -> list[tuple[dict[str, Any], tuple[str | int, ...]]]:
        entries = value.get(key, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self._error((*here, key), f"`{key}` is a list of entries with values below them")
        for index, entry in enumerate(entries):
            self._check_keys(entry, _ENTRY_KEYS[key], (*here, key, index))
        return [(entry, (*here, key, index)) for index, entry in enumerate(entries)]

    def _is_wanted(self, value: dict[str, Any], here: tuple[str | int, ...]) -> bool:
        if "if" in value and "unless" in value:
            raise self._error((*here, "unless"), "an action has either `if` or `unless`")
        for key, wanted in (("if", True), ("unless", False)):
            if key in value:
                try:
                    if truth(self._text(value, key, here)) is not wanted:
                        return False
                except SubstitutionError as error:
                    raise self._error((*here, key), str(error)) from error
        return True

    def _words(self, value: dict[str, Any], key: str, here: tuple[str | int, ...]) -> list[str]:
        text = self._given(value, key, here, "")
        try:
            words = self._substitutions.words(text)
        except SubstitutionError as error:
            raise self._error((*here, key), f"`{key}`: {error}") from error
        return [self._sound(word, (*here, key)) for word in words]

    def _text(
        self, value: dict[str, Any], key: str, here: tuple[str | int, ...], default: str | None = None
    ) -> str:
        text = self._given(value, key, here, default)
        try:
            return self._sound(self._substitutions.text(text), (*here, key))
        except SubstitutionError as error:
            raise self._error((*here, key), str(error)) from error

    def _given(
        self, value: dict[str, Any], key: str, here: tuple[str | int, ...], default: str | None
    ) -> str:
        found = value.get(key, default)
        if found is None:
            raise self._error(here, f"`{key}` is missing")
        if isinstance(found, str):
            return found
        if not isinstance(found, bool | int | float):
            raise self._error((*here, key), f"`{key}` must be a text")
        text = str(found).lower() if isinstance(found, bool) else str(found)
        if key not in _MAY_BE_TRUTHS:
            self._note((*here, key), f'`{key}` is no text, which `ros2 launch` refuses: write "{text}"')
        return text

    @property
    def _substitutions(self) -> Substitutions:
        return Substitutions(self._variables, str(self._folder))

    def _sound(self, text: str, here: tuple[str | int, ...]) -> str:
        if "\0" in text:
            raise self._error(here, "a text must not contain the character NUL")
        return text

    def _check_keys(self, value: dict[str, Any], known: frozenset[str], here: tuple[str | int, ...]) -> None:
        for key in value:
            if key in _IGNORED_KEYS:
                self._note((*here, key), f"`{key}` is left out")
            elif key not in known:
                raise self._error((*here, key), f"there is no {key!r} here", ", ".join(sorted(known)))

    def _note(self, here: tuple[str | int, ...], text: str) -> None:
        line, column = self._document.place(here)
        self._notes.append(f"{self._file}:{line}:{column}: {text}")

    def _error(self, here: tuple[str | int, ...], message: str, hint: str = "") -> DocumentError:
        line, column = self._document.place(here)
        return DocumentError([Problem(message, line, column, CODE, hint)], self._file)


def _joined(namespace: str, inner: str) -> str:
    """Returns a namespace within another; one that begins with a slash stands alone, as in launch_ros."""
    return inner if not namespace or inner.startswith("/") else f"{namespace.rstrip('/')}/{inner}".rstrip("/")
