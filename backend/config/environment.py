"""What the environment may set: one typed table, prefix `BT_STUDIO_`, wrong values refused by name."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import Literal

from pydantic import Field, SecretStr, ValidationError, field_validator
from pydantic_settings import BaseSettings, SettingsConfigDict, SettingsError

PREFIX = "BT_STUDIO_"
REPOSITORY = Path(__file__).resolve().parents[2]
MEBIBYTE = 1024 * 1024


class InvalidEnvironmentError(ValueError):
    """A setting has a value that cannot be used; the text names the variable."""


class Environment(BaseSettings):
    """The settings of the web server; each field is the variable `BT_STUDIO_<FIELD>`."""

    model_config = SettingsConfigDict(env_prefix=PREFIX, extra="ignore", frozen=True)

    data_dir: Path = Field(
        default=REPOSITORY / "var",
        description="Folder of the database, the secret key and the files of running sessions.",
    )
    frontend_dir: Path = Field(
        default=REPOSITORY / "frontend" / "dist", description="The built front end that `serve` hands out."
    )
    templates_dir: Path = Field(
        default=REPOSITORY / "examples",
        description="Folder of the projects that the start page offers as templates.",
    )
    host: str = Field(
        default="127.0.0.1", description="Address that `serve` listens on; without accounts loopback only."
    )
    port: int = Field(
        default=8000, ge=0, le=65535, description="Port that `serve` listens on; 0 takes a free one."
    )
    allowed_hosts: tuple[str, ...] = Field(
        default=(),
        description="Further host names (a JSON list) that requests may name, besides those of loopback.",
    )
    token: SecretStr = Field(
        default=SecretStr(""),
        description="Token of the link that `serve` prints; made anew at each start when it is empty.",
    )
    launcher: Literal["process"] = Field(
        default="process", description="What starts the executor of a running project."
    )
    session_start_timeout_s: float = Field(
        default=30.0, gt=0, description="How long an executor may take to report that it is ready."
    )
    session_stop_timeout_s: float = Field(
        default=5.0, gt=0, description="How long an executor may take to end before it is killed."
    )
    max_file_bytes: int = Field(default=32 * MEBIBYTE, gt=0, description="Largest file of a project.")
    max_project_bytes: int = Field(
        default=256 * MEBIBYTE, gt=0, description="Sum of the current files of a project."
    )
    max_project_files: int = Field(default=5000, gt=0, description="Number of current files of a project.")
    max_user_bytes: int = Field(
        default=4096 * MEBIBYTE, gt=0, description="Sum of the current files of all projects of one user."
    )
    max_user_projects: int = Field(default=2000, gt=0, description="Number of projects of one user.")
    max_request_bytes: int = Field(default=64 * MEBIBYTE, gt=0, description="Largest body of a request.")
    deleted_project_days: int = Field(
        default=30, ge=0, description="Days after which a deleted project can no longer be restored."
    )
    draft_days: int = Field(default=30, ge=1, description="Days after which an unsaved draft is forgotten.")
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        default="info", description="Least severe log line that is printed."
    )

    @field_validator("data_dir", "frontend_dir", "templates_dir")
    @classmethod
    def _absolute(cls, value: Path) -> Path:
        return value.expanduser().absolute()


def sentence(error: ValidationError) -> str:
    """Says in one line which variables are wrong, and why."""
    parts = []
    for problem in error.errors():
        name = PREFIX + "_".join(str(part) for part in problem["loc"][:1]).upper()
        parts.append(f"{name}: {problem['msg']} (it is {problem['input']!r})")
    return "; ".join(parts)


@lru_cache(maxsize=1)
def environment() -> Environment:
    """Reads the environment once.

    Raises:
        InvalidEnvironmentError: a variable has a value that cannot be used.
    """
    try:
        return Environment()
    except SettingsError as error:
        name = re.search(r'field "(\w+)"', str(error))
        variable = PREFIX + (name[1].upper() if name else "…")
        raise InvalidEnvironmentError(f"{variable}: this is not valid JSON") from error
    except ValidationError as error:
        raise InvalidEnvironmentError(sentence(error)) from error
