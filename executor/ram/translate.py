"""Translates commands, states and errors between the RAM dialect and the native protocol. No I/O."""

from __future__ import annotations

import base64
import io
import json
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, Final

from executor import messages
from executor.session.ladder import State
from executor.universes.loader import BUILTIN_IDS
from translator.unzip import DAMAGED, ArchiveTooLargeError, open_zip

if TYPE_CHECKING:
    from msgspec import Struct

__all__ = ["Native", "RamError", "error_text", "state_name", "to_native"]

_RENAMED: Final = {
    "launch_world": "launch_universe",
    "prepare_tools": "prepare_visualization",
    "terminate_tools": "terminate_visualization",
    "terminate_world": "terminate_universe",
}
_SAME: Final = frozenset(
    {
        "connect", "disconnect", "pause", "prepare_visualization", "resume", "run_application",
        "terminate_application", "terminate_universe", "terminate_visualization",
    }
)  # fmt: skip
_NOT_OFFERED: Final = frozenset({"code_analysis", "code_autocomplete", "code_format", "style_check"})
_VISUALIZATIONS: Final = frozenset(
    {"none", "console", "gazebo_gra", "gazebo_rae", "physic_gra", "physic_rae", "bt_studio"}
)
WORLD_ALIASES: Final = {
    "autoparking": "warehouse",
    "empty_world": "empty",
    "football_world": "football",
    "follow_line": "line",
    "follow_person": "person_in_green",
    "follow_person_ros2": "person_in_green",
    "hospital_follow_person": "person_in_green",
    "laser_bump_and_go": "walled_room",
    "maze_world": "maze",
    "obstacle_avoidance": "circuit_obstacles",
    "obstacle_avoidance_default": "circuit_obstacles",
    "receptionist": "house",
    "simple_circuit": "circuit",
    "simple_circuit_obstacles": "circuit_obstacles",
    "small_house": "house",
    "small_warehouse_with_amazon_robot": "warehouse",
    "turtlebot2": "walled_room",
    "vacuum_cleaner": "house",
    "warehouse_world": "warehouse",
}
SMALL_FILE_BYTES: Final = 1 << 20


class RamError(Exception):
    """The command is refused; the text is for the client."""


@dataclass(frozen=True)
class Native:
    """A command of the native protocol.

    `is_2024` is the client's version of the dialect, if the command shows it.
    """

    command: str
    data: Struct
    is_2024: bool | None = None


def to_native(command: str, data: Any) -> Native:
    """Returns the native command of a command of the dialect.

    Raises:
        RamError: there is no such command, or its data are invalid.
    """
    if command in _NOT_OFFERED:
        raise RamError(f"{command} is not offered here: BT Studio's own editor does that")
    name = _RENAMED.get(command, command)
    if command not in _RENAMED and command not in _SAME:
        raise RamError(f"Do not know event named '{command}'.")
    match command:
        case "launch_world":
            return Native(name, messages.LaunchUniverse(universe=_universe_of(data)))
        case "prepare_visualization":
            if not isinstance(data, str) or data not in _VISUALIZATIONS:
                known = ", ".join(sorted(_VISUALIZATIONS))
                raise RamError(f"there is no visualization {data!r}; there are {known}")
            return Native(name, messages.Empty(), is_2024=True)
        case "prepare_tools":
            if not isinstance(data, dict) or not isinstance(data.get("tools", []), list):
                raise RamError("prepare_tools needs a list of tools")
            return Native(name, messages.Empty(), is_2024=False)
        case "run_application":
            return Native(name, _application_of(data))
        case _:
            return Native(name, messages.Empty())


def state_name(state: str, *, is_2024: bool) -> str:
    """Returns the dialect's name of a state."""
    if state == State.UNIVERSE_READY:
        return "world_ready"
    if state == State.VISUALIZATION_READY:
        return "visualization_ready" if is_2024 else "tools_ready"
    return state


def error_text(error: messages.Error, trigger: str, state: str) -> str:
    """Returns an error in the form of the dialect.

    For an illegal command it is the text that clients know.
    """
    if error.code == "wrong_state":
        return f'"Can\'t trigger event {trigger} from state {state}!"'
    return f"{error.message} {error.hint}".strip()


def _universe_of(data: Any) -> str:
    if not isinstance(data, dict):
        raise RamError("launch_world needs an object with the world's name")
    scene = data.get("scene")
    source: dict[str, Any] = scene if isinstance(scene, dict) else data
    if source.get("zip"):
        raise RamError("a world of its own in a zip is not read here; import it as a universe of a project")
    if isinstance(scene, dict) and "type" in scene and scene["type"] is None:
        return "empty"
    names = [str(source.get("name") or ""), str(data.get("name") or "")]
    names.append(PurePosixPath(str(source.get("launch_file_path") or "")).name.partition(".")[0])
    for name in names:
        plain = name.strip().lower().replace(" ", "_").replace("-", "_")
        if plain in BUILTIN_IDS:
            return plain
        if plain in WORLD_ALIASES:
            return WORLD_ALIASES[plain]
    known = ", ".join(sorted({*BUILTIN_IDS, *WORLD_ALIASES}))
    raise RamError(f"the world {names[0] or names[2]!r} is not known here; there are {known}")


def _application_of(data: Any) -> messages.RunApplication:
    code = data.get("code") if isinstance(data, dict) else None
    if not isinstance(code, str) or not code:
        raise RamError("User code not found")
    head, comma, archive = code.partition(",")
    if not comma or not head.startswith("data:") or not head.endswith(";base64"):
        raise RamError("the code is not a data URL: it must begin with data:…;base64, before the zip")
    settings = _settings_of(archive)
    tick_hz = settings.get("tick_hz")
    is_rate = isinstance(tick_hz, int | float) and not isinstance(tick_hz, bool) and 0 < tick_hz <= 1000
    # RAM's program in these zips, `execute_docker.py`, ticks forever, so "repeat" is the default.
    finish: messages.OnFinish = "stop" if settings.get("on_finish") == "stop" else "repeat"
    return messages.RunApplication(
        archive, tick_hz=float(tick_hz) if is_rate and tick_hz is not None else 20.0, on_finish=finish
    )


def _settings_of(archive: str) -> dict[str, Any]:
    """Returns the `project.json` of a zip that BT Studio made.

    Empty if the archive is bad, which is reported later.
    """
    try:
        with open_zip(io.BytesIO(base64.b64decode(archive))) as files:
            if "project.json" not in files.namelist():
                return {}
            with files.open("project.json") as file:
                found = json.loads(file.read(SMALL_FILE_BYTES))
    except (ArchiveTooLargeError, *DAMAGED):
        return {}
    return found if isinstance(found, dict) else {}
