"""Reads the `launch/*.launch.yaml` files of an application: arguments, nodes, parameters and remappings.

It supports the part of ROS 2's format that needs no `launch` package: `arg`, `let`, `node`, `executable` and
`group`, with `$(var …)`, `$(dirname)`, `if` and `unless`. Known elements that are not supported are left out,
with a note. Errors are reported with their line.
"""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Any, Final

from executor.launching.find import LAUNCH_PY_REFUSAL, NotFound, find_command, find_executable, has_launch
from executor.launching.model import LaunchPlan, NodeSpec
from executor.launching.navigators import may_navigate
from executor.launching.substitution import SubstitutionError, substitute, truth
from executor.universes.document import DocumentError, Located, Problem, read_yaml

__all__ = ["CODE", "MOST_NODES", "read_launch_files"]

MOST_NODES: Final = 32
CODE: Final = "BTL001"
_LEFT_OUT: Final = frozenset(
    {
        "append_env", "include", "log", "node_container", "push-ros-namespace", "push_ros_namespace",
        "reset", "set_env", "set_parameter", "set_remap", "timer", "unset_env",
    }
)  # fmt: skip
_NODE_KEYS: Final = frozenset(
    {"pkg", "exec", "name", "namespace", "args", "ros_args", "param", "remap", "env", "if", "unless"}
)
_IGNORED_KEYS: Final = frozenset(
    {
        "output",
        "emulate_tty",
        "respawn",
        "respawn_delay",
        "launch-prefix",
        "cwd",
        "shell",
        "on_exit",
        "choice",
    }
)
_EXECUTABLE_KEYS: Final = frozenset({"cmd", "name", "env", "if", "unless"})


def read_launch_files(root: Path) -> LaunchPlan:
    """Reads the launch files of an unpacked application, in the order of their names.

    Raises:
        DocumentError: a file cannot be read; with its place.
    """
    nodes: list[NodeSpec] = []
    notes: list[str] = []
    for path in sorted((root / "launch").glob("*.launch.*")):
        if path.name.endswith(".launch.py"):
            nodes.append(_python_launch(root, path))
        elif path.name.endswith((".launch.yaml", ".launch.yml")):
            reader = _Reader(root, path, nodes, notes)
            reader.read()
    return LaunchPlan(tuple(nodes), tuple(notes), str(root))


def _python_launch(root: Path, path: Path) -> NodeSpec:
    file = path.relative_to(root).as_posix()
    spec = NodeSpec(file, path.name, "", file, file, 1)
    if not has_launch():
        return NodeSpec(file, path.name, "", file, file, 1, refusal=LAUNCH_PY_REFUSAL)
    command = (sys.executable, "-m", "executor.launching.launch_py", str(path))
    return NodeSpec(spec.id, spec.name, "", file, file, 1, command=command)


class _Reader:
    """Reads one launch file, and adds its nodes and notes to lists that all files share."""

    def __init__(self, root: Path, path: Path, nodes: list[NodeSpec], notes: list[str]) -> None:
        self._root = root
        self._folder = path.parent
        self._path = path
        self._file = path.relative_to(root).as_posix()
        self._nodes = nodes
        self._notes = notes
        self._variables: dict[str, str] = {}
        self._document = Located(None, {})

    def read(self) -> None:
        try:
            text = self._path.read_text(encoding="utf-8")
        except UnicodeDecodeError as error:
            raise DocumentError([Problem("the file is not UTF-8 text", code=CODE)], self._file) from error
        self._document = read_yaml(text, self._file)
        top = self._document.value
        if not isinstance(top, dict) or not isinstance(top.get("launch"), list):
            raise self._error((), "a launch file is `launch:` with a list of actions")
        self._actions(top["launch"], ("launch",))

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
        elif kind in {"arg", "let", "node", "executable"}:
            if not isinstance(value, dict):
                raise self._error(here, f"`{kind}` has values such as `name:`")
            getattr(self, f"_{kind}")(value, here)
        else:
            raise self._error(here, f"there is no action {kind!r}", "arg, let, node, executable, group")

    def _group(self, value: Any, here: tuple[str | int, ...]) -> None:
        if not isinstance(value, list):
            raise self._error(here, "`group` has a list of actions")
        outside = dict(self._variables)
        self._actions(value, here)
        self._variables = outside

    def _arg(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
        name = self._text(value, "name", here)
        if "default" in value:
            self._variables[name] = self._text(value, "default", here)
        self._check_keys(value, frozenset({"name", "default", "description"}), here)

    def _let(self, value: dict[str, Any], here: tuple[str | int, ...]) -> None:
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
                f"{self._file}:{line}", name, package or "", executable, self._file, line, command,
                environment, refusal, may_navigate(package or "", command),
            )
        )  # fmt: skip

    # --- parts of a node --------------------------------------------------------------------------

    def _ros_arguments(self, value: dict[str, Any], here: tuple[str | int, ...], name: str) -> list[str]:
        words = ["-r", f"__node:={name}"] if name else []
        if namespace := self._text(value, "namespace", here, ""):
            words += ["-r", f"__ns:=/{namespace.strip('/')}"]
        for remap, place in self._entries(value, "remap", here):
            words += ["-r", f"{self._text(remap, 'from', place)}:={self._text(remap, 'to', place)}"]
        for param, place in self._entries(value, "param", here):
            words += self._parameter(param, place, "")
        return words

    def _parameter(self, param: dict[str, Any], here: tuple[str | int, ...], prefix: str) -> list[str]:
        if "from" in param:
            name = self._text(param, "from", here)
            path = next((p for p in (self._root / name, self._folder / name) if p.is_file()), None)
            if path is None or not path.resolve().is_relative_to(self._root.resolve()):
                raise self._error((*here, "from"), f"there is no file {name!r} in the project")
            return ["--params-file", str(path)]
        name = prefix + self._text(param, "name", here)
        if "param" in param:
            words: list[str] = []
            for inner, place in self._entries(param, "param", here):
                words += self._parameter(inner, place, f"{name}.")
            return words
        if "value" not in param:
            raise self._error(here, f"the parameter {name!r} has no value")
        return ["-p", f"{name}:={self._parameter_text(param['value'], (*here, 'value'))}"]

    def _parameter_text(self, value: Any, here: tuple[str | int, ...]) -> str:
        if isinstance(value, list):
            items = (self._parameter_text(item, (*here, i)) for i, item in enumerate(value))
            return f"[{', '.join(items)}]"
        if isinstance(value, bool):
            return str(value).lower()
        if isinstance(value, str):
            # A text that is a number after its substitutions becomes one, as in ROS.
            return self._substituted(value, here)
        if isinstance(value, int | float):
            return repr(value)
        raise self._error(here, "a parameter is a number, a text, true or false, or a list of them")

    def _environment(self, value: dict[str, Any], here: tuple[str | int, ...]) -> tuple[tuple[str, str], ...]:
        entries = self._entries(value, "env", here)
        return tuple((self._text(e, "name", place), self._text(e, "value", place)) for e, place in entries)

    def _entries(
        self, value: dict[str, Any], key: str, here: tuple[str | int, ...]
    ) -> list[tuple[dict[str, Any], tuple[str | int, ...]]]:
        entries = value.get(key, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self._error((*here, key), f"`{key}` is a list of entries with values below them")
        return [(entry, (*here, key, index)) for index, entry in enumerate(entries)]

    def _is_wanted(self, value: dict[str, Any], here: tuple[str | int, ...]) -> bool:
        for key, wanted in (("if", True), ("unless", False)):
            if key in value:
                try:
                    if truth(self._text(value, key, here)) is not wanted:
                        return False
                except SubstitutionError as error:
                    raise self._error((*here, key), str(error)) from error
        return True

    def _words(self, value: dict[str, Any], key: str, here: tuple[str | int, ...]) -> list[str]:
        text = self._text(value, key, here, "")
        try:
            return shlex.split(text)
        except ValueError as error:
            raise self._error((*here, key), f"`{key}` cannot be split into words: {error}") from error

    def _text(
        self, value: dict[str, Any], key: str, here: tuple[str | int, ...], default: str | None = None
    ) -> str:
        found = value.get(key, default)
        if found is None:
            raise self._error(here, f"`{key}` is missing")
        if isinstance(found, bool):
            return str(found).lower()
        if not isinstance(found, str | int | float):
            raise self._error((*here, key), f"`{key}` must be a text")
        return self._substituted(str(found), (*here, key))

    def _substituted(self, text: str, here: tuple[str | int, ...]) -> str:
        try:
            result = substitute(text, self._variables, str(self._folder))
        except SubstitutionError as error:
            raise self._error(here, str(error)) from error
        if "\0" in result:
            raise self._error(here, "a text must not contain the character NUL")
        return result

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
