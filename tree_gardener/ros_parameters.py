"""The parameters of the node that ticks a tree: read once and checked; errors name the place.

An argument (`--tick_hz=5.0`, outside of `--ros-args`) overrides all files of parameters. Among files and ROS
2's own `-p`, the last one does not always win. If one gives a whole number and a later one a decimal number,
rcl keeps both and uses the whole number. Sections apply in the order in which they first appear in any file.
"""

import dataclasses
import math
import pathlib
import re
from collections.abc import Mapping, Sequence
from typing import Any, Final, TypeVar

from tree_gardener.groot.publisher import LAST_PORT, LOCALHOST
from tree_gardener.runner import ON_ERROR, ON_FINISH

SIM_TIME = "use_sim_time"
PREEMPT: Final = "preempt"
QUEUE: Final = "queue"
REJECT: Final = "reject"
CMD_TIMEOUT_S: Final = 0.5
ON_NEW_GOAL: Final = (PREEMPT, QUEUE, REJECT)


class ParameterError(Exception):
    """A parameter that the node cannot use; the text names it, the reason and the place."""


@dataclasses.dataclass(frozen=True)
class RunParameters:
    """The parameters of a run.

    Attributes:
        tree: the tree's XML.
        tick_hz: ticks a second.
        on_finish: ``stop`` or ``repeat``.
        on_error: ``stop`` or ``failure``.
        groot2_port: the port at which Groot2 can follow the tree; 0 for none.
        groot2_host: the address to listen at for it.
        cmd_timeout_s: the seconds without a command after which the motion that it commanded is stopped; 0
            for never.
    """

    tree: pathlib.Path
    tick_hz: float
    on_finish: str
    on_error: str
    groot2_port: int = 0
    groot2_host: str = LOCALHOST
    cmd_timeout_s: float = CMD_TIMEOUT_S


@dataclasses.dataclass(frozen=True)
class ServerParameters:
    """The parameters of a server of trees. A goal always ends with its tree, so there is no ``on_finish``.

    Attributes:
        tree: the XML with the trees.
        tick_hz: ticks a second.
        on_error: ``stop`` or ``failure``.
        action_name: the name of its action.
        on_new_goal: ``preempt``, ``queue`` or ``reject``.
        groot2_port, groot2_host, cmd_timeout_s: as of `RunParameters`, for the tree that runs.
    """

    tree: pathlib.Path
    tick_hz: float
    on_error: str
    action_name: str
    on_new_goal: str
    groot2_port: int = 0
    groot2_host: str = LOCALHOST
    cmd_timeout_s: float = CMD_TIMEOUT_S


Parameters = TypeVar("Parameters", RunParameters, ServerParameters)


_MEANINGS: Final = {
    "tree": "path of the tree's XML",
    "tick_hz": "ticks a second",
    "on_finish": "when the tree ends: stop, or repeat",
    "on_error": "when an action raises an error: stop, or failure of that action alone",
    "cmd_timeout_s": "seconds without a command after which what the tree moves is stopped; 0: never",
    "action_name": "the server's action",
    "on_new_goal": "while a tree runs: preempt it, queue the goal, or reject it",
    "groot2_port": "port at which Groot2 can follow the tree; 0 for none",
    "groot2_host": "address to listen at for Groot2",
    SIM_TIME: "true to tick by simulated time, false for the computer's",
}

NAMES = (*(field.name for field in dataclasses.fields(RunParameters)), SIM_TIME)


def asks_for_help(words: Sequence[str]) -> bool:
    """Returns whether a command line has ``--help`` or ``-h`` outside of the arguments for ROS."""
    is_for_ros = False
    for word in words:
        is_for_ros = word != "--" and (is_for_ros or word == "--ros-args")
        if not is_for_ros and word in {"--help", "-h"}:
            return True
    return False


def help_text(name: str, what: str, defaults: RunParameters | ServerParameters) -> str:
    """Returns the help of a program: its arguments with their defaults, and where else they are set.

    Args:
        name: the name of the node.
        what: a sentence about the program.
        defaults: the values of its parameters.
    """
    values = {field.name: getattr(defaults, field.name) for field in dataclasses.fields(defaults)}
    rows = [
        f"  --{key}=…".ljust(20) + f"{_MEANINGS[key]} (default: {_shown(value)})"
        for key, value in {**values, "tree": str(defaults.tree), SIM_TIME: False}.items()
    ]
    return "\n".join(
        (
            f"{name}: {what}",
            "",
            f"Usage: {name} [--PARAMETER=VALUE …] [--ros-args …]",
            "",
            *rows,
            f"  {'--help, -h':<18}print this and end",
            "",
            "Each is a parameter of the node, too: --ros-args -p NAME:=VALUE, or --params-file FILE.",
            "--ros-args -r OLD:=NEW changes names, -r __ns:=/robot1 the namespace.",
        )
    )


def read_arguments(
    words: Sequence[str], parameters: type[RunParameters | ServerParameters] = RunParameters
) -> dict[str, Any]:
    """Returns the parameters that the words of a command line give, without those for ROS.

    Args:
        words: the command line.
        parameters: the parameters that there are.

    Raises:
        ParameterError: A word is not a parameter, or a switch is neither true nor false.
    """
    values: dict[str, Any] = {}
    names = (*(field.name for field in dataclasses.fields(parameters)), SIM_TIME)
    for word in words:
        name, sign, text = word.removeprefix("--").partition("=")
        if not word.startswith("--") or not sign or name not in names:
            known = ", ".join(f"--{each}=…" for each in names)
            raise ParameterError(f"the argument {word!r} is not known; there are {known}")
        values[name] = text
    for number in values.keys() & {"tick_hz", "cmd_timeout_s"}:
        values[number] = _number(values[number])
    if values.get("groot2_port", "").isdecimal():
        values["groot2_port"] = int(values["groot2_port"])
    if SIM_TIME in values:
        if values[SIM_TIME].lower() not in {"true", "false"}:
            raise ParameterError(f"the argument --{SIM_TIME}={values[SIM_TIME]} has to be true or false")
        values[SIM_TIME] = values[SIM_TIME].lower() == "true"
    return values


def declare_parameters(node: Any, defaults: Parameters, words: Sequence[str]) -> Parameters:
    """Declares the parameters on a node and returns their values.

    They are read-only, since they are read once when the run begins; ``ros2 param set`` reports that.

    Args:
        node: the rclpy node.
        defaults: the values of those that are not given.
        words: the command line, to find the place of a wrong value.

    Raises:
        ParameterError: A value has the wrong type, or is not one of those that a run has.
    """
    values = {
        field.name: _declared(node, field.name, getattr(defaults, field.name))
        for field in dataclasses.fields(defaults)
    }
    problems = [
        f"the parameter {name} is {_shown(values[name])}, but has to be {wanted}{_place(name, words)}"
        for name, wanted in _problems(values)
    ]
    if problems:
        raise ParameterError("; ".join(problems))
    values |= {
        "tree": pathlib.Path(values["tree"]),
        "tick_hz": float(values["tick_hz"]),
        "groot2_port": int(values["groot2_port"]),
        "cmd_timeout_s": float(values["cmd_timeout_s"]),
    }
    return dataclasses.replace(defaults, **values)


def sim_time_problem(words: Sequence[str]) -> str:
    """Returns the reason why rclpy refuses a node for its ``use_sim_time``."""
    return f"the parameter {SIM_TIME} has to be true or false, without quotes{_place(SIM_TIME, words)}"


def _declared(node: Any, name: str, default: Any) -> Any:
    from rcl_interfaces.msg import ParameterDescriptor  # noqa: PLC0415 - the engine works without ROS

    # Any type is accepted here, so that this module judges it and not rclpy: a whole number is a number too.
    descriptor = ParameterDescriptor(name=name, read_only=True, dynamic_typing=True)
    value = str(default) if isinstance(default, pathlib.Path) else default
    return node.declare_parameter(name, value, descriptor).value


def _problems(values: Mapping[str, Any]) -> list[tuple[str, str]]:
    found = []
    if not _is_number(values["tick_hz"]) or values["tick_hz"] <= 0:
        found.append(("tick_hz", "a number above 0"))
    if not _is_number(values["cmd_timeout_s"]) or values["cmd_timeout_s"] < 0:
        found.append(("cmd_timeout_s", "a number of seconds, or 0"))
    if not isinstance(values["tree"], str) or not values["tree"]:
        found.append(("tree", "the path of a file"))
    if "action_name" in values and (not isinstance(values["action_name"], str) or not values["action_name"]):
        found.append(("action_name", "the name of an action"))
    port, host = values["groot2_port"], values["groot2_host"]
    if isinstance(port, bool) or port not in range(LAST_PORT + 1):
        found.append(("groot2_port", f"a port from 1 to {LAST_PORT}, or 0"))
    if not isinstance(host, str) or not host:
        found.append(("groot2_host", "an address of this computer"))
    for name, choices in (("on_finish", ON_FINISH), ("on_error", ON_ERROR), ("on_new_goal", ON_NEW_GOAL)):
        if name in values and values[name] not in choices:
            found.append((name, _listed(choices)))
    return found


def _is_number(value: Any) -> bool:
    return not isinstance(value, bool) and isinstance(value, int | float) and math.isfinite(value)


def _number(text: str) -> "float | str":
    try:
        return float(text)
    except ValueError:
        return text  # the text is checked with the other values


def _listed(choices: Sequence[str]) -> str:
    *most, last = choices
    return f"{', '.join(most)} or {last}"


def _shown(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _place(name: str, words: Sequence[str]) -> str:
    """Returns the place on the command line: an argument, or the last file of parameters, with the line."""
    if any(word.startswith(f"--{name}=") for word in words):
        return " (an argument)"
    files = [words[i + 1] for i, word in enumerate(words[:-1]) if word == "--params-file"]
    for file in reversed(files):
        try:
            lines = pathlib.Path(file).read_text(encoding="utf-8", errors="replace").splitlines()
        except OSError:
            continue
        for number, line in reversed(list(enumerate(lines, 1))):
            if re.match(rf"""\s*["']?{name}["']?\s*:""", line):
                return f" ({file}, line {number})"
    return ""
