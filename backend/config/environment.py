"""Settings from the environment: one typed table, with the prefix `BT_STUDIO_`."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, SecretStr, ValidationError, field_validator, model_validator
from pydantic_settings import SettingsConfigDict, SettingsError

from backend.config.object_store import ObjectStoreSettings
from backend.config.team import MissingSettingError, TeamSettings
from backend.core.limits import LIMITS

PREFIX = "BT_STUDIO_"
REPOSITORY = Path(__file__).resolve().parents[2]
MEBIBYTE = 1024 * 1024
RELAY_PORT = 7164
LONGEST_HOST = 150
"""Characters of a host's name: addresses of sessions, which contain it, have 200 at most."""
HOST_ADDRESS = re.compile(r"(?P<host>[0-9a-z]([0-9a-z.-]*[0-9a-z])?|\[[0-9a-f:]+\])(:(?P<port>\d{1,5}))?")


class InvalidEnvironmentError(ValueError):
    """A setting has an invalid value; the text names the variable."""


class Environment(ObjectStoreSettings, TeamSettings):
    """The settings of the web server; the variable of each field is `BT_STUDIO_<FIELD>`."""

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
        default="127.0.0.1", description="Address that `serve` listens on; beyond loopback in team mode only."
    )
    port: int = Field(
        default=8000, ge=0, le=65535, description="Port that `serve` listens on; 0 takes a free one."
    )
    workers: int = Field(
        default=0,
        ge=0,
        le=64,
        description="Processes that answer requests. 0: on a server with accounts, PostgreSQL and containers "
        "one less than there are processor cores; else 1, and more are refused.",
    )
    allowed_hosts: tuple[str, ...] = Field(
        default=(),
        description="Host names (a JSON list) that requests may name, in addition to those of loopback.",
    )
    token: SecretStr = Field(
        default=SecretStr(""),
        description="Token of the link that `serve` prints; when it is empty, each start makes a new one.",
    )
    launcher: Literal["process", "docker", "kubernetes"] = Field(
        default="process",
        description="What starts the executor of a project: `process` a child, `docker` a container, "
        "`kubernetes` a pod of a cluster.",
    )
    keeper_folder: Path = Field(
        default=Path("/run/bt-studio-keeper"),
        description="Folder shared with the keeper, with the sockets of the executors that it started.",
    )
    executor_hosts: tuple[str, ...] = Field(
        default=(),
        description="Further machines (a JSON list of HOST or HOST:PORT) on which `docker` starts executors.",
    )
    pod_template: Path = Field(
        default=Path("/etc/bt-studio/executor-pod.yaml"),
        description="The pod that `kubernetes` makes for each session (docker/kubernetes/executor-pod.yaml).",
    )
    tools_template: Path = Field(
        default=Path("/etc/bt-studio/tools-pod.yaml"),
        description="The pod that `kubernetes` makes for a user who edits Python "
        "(docker/kubernetes/tools-pod.yaml).",
    )
    pod_namespace: str = Field(
        default="bt-studio-sessions", description="The namespace in which `kubernetes` makes these pods."
    )
    evaluations: Literal["session", "rayjob"] = Field(
        default="session",
        description="Where evaluations run: `session` in an executor as those of projects, `rayjob` each in "
        "a Ray cluster of its own, which the KubeRay operator makes (needs `kubernetes`).",
    )
    rayjob_template: Path = Field(
        default=Path("/etc/bt-studio/evaluation-rayjob.yaml"),
        description="The RayJob that `rayjob` makes for each evaluation, with the network policy of its pods "
        "(docker/kubernetes-evaluations/evaluation-rayjob.yaml).",
    )
    evaluation_namespace: str = Field(
        default="bt-studio-evaluations", description="The namespace in which `rayjob` makes RayJobs."
    )
    rayjob_start_timeout_s: float = Field(
        default=300.0, gt=0, description="How long the Ray cluster of an evaluation may take to be complete."
    )
    max_sessions: int = Field(
        default=0, ge=0, description="How many executors may run at once; further ones wait. 0: no limit."
    )
    warm_sessions: int = Field(
        default=0,
        ge=0,
        description="How many pods `kubernetes` keeps ready for the next sessions, which then start at once.",
    )
    session_idle_minutes: float = Field(
        default=0,
        ge=0,
        description="An executor that is not used for so long is ended, after a warning. 0: never.",
    )
    published_on_loopback: bool = Field(
        default=False,
        description="Local mode in a container whose port is published on the host's loopback only.",
    )
    max_evaluations: int = Field(
        default=1, ge=1, description="How many evaluations may run at once; further ones wait."
    )
    evaluation_hours_a_day: float = Field(
        default=0,
        ge=0,
        description="Processor hours that the evaluations of one user may take in 24 hours. 0: no limit.",
    )
    max_outcome_bytes: int = Field(
        default=512 << 20,
        gt=0,
        description="Size of all outcomes of a project's evaluations; one that would exceed it ends.",
    )
    session_start_timeout_s: float = Field(
        default=30.0, gt=0, description="How long an executor may take to report that it is ready."
    )
    session_stop_timeout_s: float = Field(
        default=5.0, gt=0, description="How long an executor may take to end before it is killed."
    )
    session_silence_s: float = Field(
        default=10.0, ge=4, description="How long an executor may leave pings unanswered before it is ended."
    )
    max_file_bytes: int = Field(default=LIMITS["file_bytes"], gt=0, description="Largest file of a project.")
    max_project_bytes: int = Field(
        default=LIMITS["project_bytes"], gt=0, description="Sum of the current files of a project."
    )
    max_project_files: int = Field(
        default=LIMITS["files_per_project"], gt=0, description="Number of current files of a project."
    )
    max_user_bytes: int = Field(
        default=4096 * MEBIBYTE, gt=0, description="Sum of the current files of all projects of one user."
    )
    max_user_run_bytes: int = Field(
        default=4096 * MEBIBYTE, gt=0, description="Sum of all stored runs of one user."
    )
    keep_last_runs: bool = Field(
        default=True,
        description="Whether the last run of each user in a project is kept when its session ends.",
    )
    max_user_projects: int = Field(default=2000, gt=0, description="Number of projects of one user.")
    max_request_bytes: int = Field(
        default=64 * MEBIBYTE,
        gt=0,
        description="Largest body of a request of somebody who is signed in; of others a megabyte is read. "
        "An archive that is imported may be as large as its user has room.",
    )
    max_temporary_bytes: int = Field(
        default=8192 * MEBIBYTE,
        gt=0,
        description="Room for all large bodies, uploads and downloads of all users that are on their way, "
        "of one server. Its workers share it equally.",
    )
    min_free_bytes: int = Field(
        default=512 * MEBIBYTE,
        ge=0,
        description="The space on the disk of the data folder that temporary files leave free.",
    )
    work_deadline_s: float = Field(
        default=10.0,
        gt=0,
        description="How long translating, checking, comparing or packing a project may take.",
    )
    deleted_project_days: int = Field(
        default=30, ge=0, description="Days after which a deleted project can no longer be restored."
    )
    draft_days: int = Field(default=30, ge=1, description="Days after which an unsaved draft is forgotten.")
    max_language_servers: int = Field(
        default=16, ge=0, description="Number of editors that get help with Python at a time; 0 for none."
    )
    language_idle_s: float = Field(
        default=900.0, gt=0, description="After how long without typing a language server is ended."
    )
    language_memory_mib: int = Field(
        default=1024, gt=0, description="Memory that one language server may take before it is ended."
    )
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        default="info", description="Least severe log line that is printed; `debug` has each request."
    )
    log_style: Literal["text", "json"] = Field(
        default="text", description="How log lines are written: for people, or one JSON object a line."
    )
    metrics_token: SecretStr = Field(
        default=SecretStr(""),
        description="Bearer token for `/metrics`; without one only clients on this machine are answered.",
    )

    @property
    def may_be_several(self) -> bool:
        """Whether several servers may share one data folder, one database and one host.

        Two servers can share neither an SQLite file nor the child processes of one of them.
        """
        return self.is_team and self.is_postgresql and self.launcher != "process"

    @property
    def hosts_folder(self) -> Path:
        """The folder of the certificates of further machines."""
        return self.data_dir / "hosts"

    @property
    def rayjob_file(self) -> Path | None:
        """The file of the RayJob of evaluations; None if they run as sessions do."""
        return self.rayjob_template if self.evaluations == "rayjob" else None

    @field_validator("executor_hosts")
    @classmethod
    def _hosts(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        found = tuple(_with_port(text) for text in value)
        if len(set(found)) < len(found):
            raise ValueError("a host is named twice")
        return found

    @model_validator(mode="after")
    def _launcher_fits(self) -> Self:
        if self.executor_hosts and self.launcher != "docker":
            sentence = "BT_STUDIO_EXECUTOR_HOSTS needs BT_STUDIO_LAUNCHER=docker"
            raise MissingSettingError("launcher", sentence)
        if self.evaluations == "rayjob" and self.launcher != "kubernetes":
            sentence = "BT_STUDIO_EVALUATIONS=rayjob needs BT_STUDIO_LAUNCHER=kubernetes"
            raise MissingSettingError("launcher", sentence)
        return self

    @field_validator(
        "data_dir",
        "frontend_dir",
        "templates_dir",
        "keeper_folder",
        "pod_template",
        "tools_template",
        "rayjob_template",
    )
    @classmethod
    def _absolute(cls, value: Path) -> Path:
        return value.expanduser().absolute()


def _with_port(text: str) -> str:
    """Returns HOST:PORT of a host as the administrator writes it."""
    found = HOST_ADDRESS.fullmatch(text.strip().lower())
    if found is None or not 0 < int(found["port"] or RELAY_PORT) < 65536:
        raise ValueError(f"“{text}” is neither HOST nor HOST:PORT")
    if len(found["host"]) > LONGEST_HOST:
        raise ValueError(f"“{text[:40]}…” has more than {LONGEST_HOST} characters")
    return f"{found['host']}:{found['port'] or RELAY_PORT}"


def sentence(error: ValidationError) -> str:
    """Returns one line that names the invalid variables, each with the reason."""
    parts = []
    for problem in error.errors():
        cause = problem.get("ctx", {}).get("error")
        if isinstance(cause, MissingSettingError):
            parts.append(f"{PREFIX}{cause.name.upper()}: {cause}")
            continue
        field = "_".join(str(part) for part in problem["loc"][:1])
        reason = problem["msg"].removeprefix("Value error, ")
        parts.append(f"{PREFIX}{field.upper()}: {reason}" + _shown(field, problem["input"]))
    return "; ".join(parts)


def _shown(field: str, value: object) -> str:
    """Returns the wrong value as text for the message; "" if the value is secret."""
    known = Environment.model_fields.get(field)
    return "" if known is not None and known.annotation is SecretStr else f" (it is {value!r})"


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
