"""`project.json`: the settings of a project, as one typed model with its JSON Schema."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.json_file import parse_json
from translator.limits import DESCRIPTION_CHARACTERS, NAME_CHARACTERS
from translator.nav2.distributions import Distribution  # noqa: TC001 - pydantic reads it
from translator.text import clean, is_clean

PROJECT_FILE = "project.json"
FORMAT = "bt-studio/project"
NO_UNIVERSE = "none"
"""The value of `universe` for a program in an outside ROS graph, without a simulated world."""


class Maintainer(BaseModel):
    """The maintainer of an exported package."""

    model_config = ConfigDict(frozen=True, extra="ignore")

    name: str = Field(default="", max_length=NAME_CHARACTERS)
    email: str = Field(default="", max_length=NAME_CHARACTERS)


class Settings(BaseModel):
    """The settings of a project. Each has a default, so that an empty file is valid."""

    model_config = ConfigDict(frozen=True, extra="ignore", json_schema_extra={"title": "project.json"})

    format: Literal["bt-studio/project"] = "bt-studio/project"
    version: Literal[1] = 1
    name: str = Field(default="Untitled", min_length=1, max_length=NAME_CHARACTERS)
    description: str = Field(default="", max_length=DESCRIPTION_CHARACTERS)
    main_tree: str = Field(default="MainTree", min_length=1, max_length=NAME_CHARACTERS)
    tick_hz: float = Field(default=20, gt=0, le=1000)
    universe: str = Field(default="empty", max_length=NAME_CHARACTERS)
    robot: str | None = Field(default=None, max_length=NAME_CHARACTERS)
    on_finish: Literal["stop", "repeat"] = "stop"
    on_error: Literal["stop", "failure"] = "stop"
    time: Literal["exact", "live"] = "live"
    ros_distro: Distribution | None = None
    license: str = Field(default="Apache-2.0", max_length=100)
    maintainer: Maintainer = Maintainer()

    def to_json(self) -> dict[str, Any]:
        """Returns the document.

        `robot` is left out if the universe's own robot is used, `time` if it is `live`, and `ros_distro` if
        the project does not state it.
        """
        document = self.model_dump()
        if self.robot is None:
            del document["robot"]
        if self.ros_distro is None:
            del document["ros_distro"]
        if self.time == "live":
            del document["time"]
        if self.tick_hz == int(self.tick_hz):
            document["tick_hz"] = int(self.tick_hz)
        return document


def read_settings(raw: bytes | str) -> tuple[Settings, tuple[Diagnostic, ...]]:
    """Reads `project.json`; an invalid setting is reported and gets its default."""
    document, problem = parse_json(raw, file=PROJECT_FILE)
    if problem is not None:
        return Settings(), (problem,)
    return restore_settings(document)


def restore_settings(document: Any) -> tuple[Settings, tuple[Diagnostic, ...]]:
    """Reads the settings as `read_settings` does, from a parsed document."""
    place = Place(PROJECT_FILE)
    if not isinstance(document, dict):
        return Settings(), (diagnostic("BT0004", place, kind="no object"),)
    found: list[Diagnostic] = []
    try:
        rows = {clean(key): _clean_value(value) for key, value in document.items()}
    except RecursionError:
        return Settings(), (
            diagnostic("BT0001", Place(PROJECT_FILE, line=1), problem="it is nested too deeply"),
        )
    for _ in range(len(Settings.model_fields) + 1):
        try:
            return Settings.model_validate(rows), tuple(found)
        except ValidationError as error:
            for name in dict.fromkeys(str(problem["loc"][0]) for problem in error.errors()):
                message = next(p["msg"] for p in error.errors() if str(p["loc"][0]) == name)
                found.append(diagnostic("BT0030", place, setting=name, problem=message))
                rows.pop(name, None)
    return Settings(), tuple(found)


def _clean_value(value: Any) -> Any:
    if isinstance(value, str):
        return value if is_clean(value) else clean(value)
    if isinstance(value, dict):
        return {key: _clean_value(item) for key, item in value.items() if isinstance(key, str)}
    return value
