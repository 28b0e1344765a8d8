"""What an executor's container may do. Everything is decided here, by the keeper's own settings."""

from __future__ import annotations

import os
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

PREFIX: Final = "BT_STUDIO_SESSION_"
TOKEN_VARIABLE: Final = "BT_STUDIO_MANAGER_TOKEN"  # noqa: S105 - the name, not the token
GATE_FOLDER: Final = "/run/bt-studio"
SESSION_LABEL: Final = "org.bt-studio.session"
STACK_LABEL: Final = "org.bt-studio.stack"
USER: Final = "10001:10001"
PORT: Final = 7163
MEBIBYTE: Final = 1024 * 1024


@dataclass(frozen=True, slots=True)
class Limits:
    """What one session may use; each is the variable `BT_STUDIO_SESSION_<NAME>`.

    Attributes:
        cpus: processor cores.
        memory_mb: memory of all its processes and of its files, which are in memory.
        pids: processes and threads.
        disk_mb: files below `/tmp`.
        shm_mb: shared memory, through which its ROS nodes exchange messages.
        hours: how long it may run.
    """

    cpus: float = 1.5
    memory_mb: float = 2048
    pids: float = 256
    disk_mb: float = 256
    shm_mb: float = 256
    hours: float = 12

    @classmethod
    def from_environment(cls, environment: Mapping[str, str]) -> Limits:
        """Reads the limits.

        Raises:
            ValueError: a variable is no positive number; the text names it.
        """
        given = {}
        for field in fields(cls):
            name = PREFIX + field.name.upper()
            if text := environment.get(name, "").strip():
                try:
                    given[field.name] = float(text)
                except ValueError:
                    raise ValueError(f"{name}: {text!r} is not a number") from None
                if not 0 < given[field.name] < 1e6:
                    raise ValueError(f"{name}: {text!r} is not between 0 and a million")
        return cls(**given)


@dataclass(frozen=True, slots=True)
class Plan:
    """How this keeper makes containers.

    Attributes:
        image: the executor's image.
        gate_source: the volume, or the folder of the host, with the gate's socket.
        stack: tells the containers of this keeper from those of another.
        grace_s: how long a session lives without clients.
    """

    image: str
    gate_source: str
    stack: str
    grace_s: float = 300
    limits: Limits = Limits()

    def container_name(self, session_id: str) -> str:
        """The name of a session's container."""
        return f"{self.stack}-session-{session_id}"

    def labels(self, session_id: str) -> dict[str, str]:
        """What its container is found by."""
        return {STACK_LABEL: self.stack, SESSION_LABEL: session_id}

    def container(self, session_id: str, token: str, domain_id: int) -> dict[str, Any]:
        """The container of a session, as Docker's API takes it."""
        limits = self.limits
        memory = int(limits.memory_mb * MEBIBYTE)
        return {
            "Image": self.image,
            "User": USER,
            "Cmd": [
                *("--host", "127.0.0.1", "--port", str(PORT), "--token-env", TOKEN_VARIABLE),
                *("--gate", f"{GATE_FOLDER}/gate.sock", "--session", session_id),
                *("--domain-id", str(domain_id), "--grace", str(self.grace_s)),
            ],
            "Env": [
                f"{TOKEN_VARIABLE}={token}",
                # An application that takes too much is told so before the kernel ends the whole session.
                f"BT_STUDIO_APPLICATION_MEMORY_MB={max(64, int(limits.memory_mb * 0.6))}",
                f"BT_STUDIO_APPLICATION_FILE_MB={max(1, int(limits.disk_mb))}",
                f"BT_STUDIO_APPLICATION_PROCESSES={max(8, int(limits.pids / 4))}",
            ],
            "Labels": self.labels(session_id),
            "Healthcheck": {"Test": ["NONE"]},  # the keeper itself looks
            "HostConfig": {
                "NetworkMode": "none",
                "ReadonlyRootfs": True,
                "CapDrop": ["ALL"],
                "SecurityOpt": ["no-new-privileges:true"],  # seccomp stays Docker's default
                "Privileged": False,
                "IpcMode": "private",
                "Init": True,
                "Memory": memory,
                "MemorySwap": memory,
                "NanoCpus": int(limits.cpus * 1e9),
                "PidsLimit": int(limits.pids),
                "OomScoreAdj": 500,
                "ShmSize": int(limits.shm_mb * MEBIBYTE),
                "Tmpfs": {"/tmp": f"rw,nosuid,nodev,noexec,mode=1777,size={int(limits.disk_mb)}m"},  # noqa: S108
                "Ulimits": [
                    {"Name": "nofile", "Soft": 4096, "Hard": 4096},
                    {"Name": "core", "Soft": 0, "Hard": 0},
                ],
                "LogConfig": {"Type": "json-file", "Config": {"max-size": "1m", "max-file": "2"}},
                "RestartPolicy": {"Name": "no"},
                "Mounts": [self._gate()],
            },
        }

    def _gate(self) -> dict[str, Any]:
        kind = "bind" if self.gate_source.startswith("/") else "volume"
        return {"Type": kind, "Source": self.gate_source, "Target": GATE_FOLDER, "ReadOnly": True}


def read_plan(environment: Mapping[str, str] = os.environ, *, gate_source: str, stack: str) -> Plan:
    """The plan that the environment describes.

    Raises:
        ValueError: a variable has a value that cannot be used; the text names it.
    """
    try:
        grace_s = float(environment.get("BT_STUDIO_SESSION_GRACE_S") or 300)
    except ValueError:
        raise ValueError("BT_STUDIO_SESSION_GRACE_S is not a number") from None
    return Plan(
        image=environment.get("BT_STUDIO_EXECUTOR_IMAGE") or "bt-studio-executor:latest",
        gate_source=gate_source,
        stack=stack,
        grace_s=grace_s,
        limits=Limits.from_environment(environment),
    )
