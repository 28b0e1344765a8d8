"""Settings from the environment: one typed table, with the prefix `BT_STUDIO_`."""

from __future__ import annotations

import os
import re
from functools import lru_cache
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, SecretStr, ValidationError, field_validator, model_validator
from pydantic_settings import SettingsConfigDict, SettingsError

from backend.config.object_store import ObjectStoreSettings
from backend.config.team import MissingSettingError, TeamSettings
from backend.core.limits import LIMITS
from backend.core.processes.memory import MEBIBYTE, WORK_MIB, Processes, fitting

PREFIX = "BT_STUDIO_"
REPOSITORY = Path(__file__).resolve().parents[2]
REMOVED = {
    "EXECUTOR_HOSTS": "this setting is gone: robots on several machines run on Kubernetes "
    "(docs/how-to/run-on-kubernetes.md, “Three machines with k3s”); unset it to run them on this machine",
}
"""What to use instead of settings of earlier releases, by name; none of them is ignored."""
_UNSAFE = (
    "on a server with accounts, `process` would run the Python of every user as the server itself, which "
    "reads and changes all projects, the database and its secrets. Set BT_STUDIO_LAUNCHER=docker or "
    "kubernetes (docs/how-to/run-a-team-server.md), or, only among people who trust each other, "
    "BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER=true"
)


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
        "one less than there are processor cores, or as many as fit into the memory of its container; else "
        "1, and more are refused.",
    )
    work_processes: int = Field(
        default=0,
        ge=0,
        le=256,
        description="Processes for large work: translating, checking, packing. 0: on a server with accounts "
        "one for each processor, at least two, as far as they fit into the memory of its container; else 1.",
    )
    work_memory_mib: int = Field(
        default=WORK_MIB, ge=256, description="Memory that one process for such work may take."
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
        description="What starts the executor of a project: `process` a child with the rights of the server, "
        "`docker` a container, `kubernetes` a pod of a cluster. A server with accounts needs one of the "
        "last two.",
    )
    unsafe_users_run_as_server: bool = Field(
        default=False,
        description="Lets a server with accounts start with the launcher `process`, by which the Python of "
        "every user runs as the server itself: it can read and change all projects, the database and its "
        "secrets. Only for people who trust each other.",
    )
    keeper_folder: Path = Field(
        default=Path("/run/bt-studio-keeper"),
        description="Folder shared with the keeper, with the sockets of the executors that it started.",
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
    max_unread_bytes_per_owner: int = Field(
        default=32 * MEBIBYTE,
        gt=0,
        description="Team mode: bytes of answers on their way to one user, or to all guests of one address; "
        "further requests are refused for a moment.",
    )
    max_unread_bytes: int = Field(
        default=256 * MEBIBYTE,
        gt=0,
        description="Bytes of answers on their way to all users of one server; messages on their way to "
        "robots may take as many again. Its workers share both equally.",
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
    max_tests: int = Field(
        default=8, ge=1, description="Number of tests with Python that run at a time; further ones wait."
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
        return self.is_team and self.is_postgresql and self.has_containers

    @property
    def has_containers(self) -> bool:
        """Whether the Python of users runs in containers or pods, where it has no rights of the server."""
        return self.launcher != "process"

    @property
    def users_run_as_server(self) -> bool:
        """Whether the Python of several users runs with the rights of the server, on purpose."""
        return self.is_team and not self.has_containers

    def processes(self, cores: int, limit_mib: int | None) -> Processes:
        """Returns the processes that this server starts; `limit_mib` is the memory of its container."""
        return fitting(
            self.mode,
            cores,
            limit_mib,
            workers=self.workers if self.may_be_several else 1,
            large=self.work_processes,
            each_mib=self.work_memory_mib,
            unread_bytes=self.max_unread_bytes,
        )

    @property
    def rayjob_file(self) -> Path | None:
        """The file of the RayJob of evaluations; None if they run as sessions do."""
        return self.rayjob_template if self.evaluations == "rayjob" else None

    @model_validator(mode="after")
    def _launcher_fits(self) -> Self:
        if self.users_run_as_server and not self.unsafe_users_run_as_server:
            raise MissingSettingError("launcher", _UNSAFE)
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
        InvalidEnvironmentError: a variable has a value that cannot be used, or is one of an earlier release.
    """
    for removed, instead in REMOVED.items():
        # Compose files of earlier releases pass an empty list on.
        if os.environ.get(PREFIX + removed, "") not in {"", "[]"}:
            raise InvalidEnvironmentError(f"{PREFIX}{removed}: {instead}")
    try:
        return Environment()
    except SettingsError as error:
        name = re.search(r'field "(\w+)"', str(error))
        variable = PREFIX + (name[1].upper() if name else "…")
        raise InvalidEnvironmentError(f"{variable}: this is not valid JSON") from error
    except ValidationError as error:
        raise InvalidEnvironmentError(sentence(error)) from error
