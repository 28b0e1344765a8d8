"""The rights of the containers of executors and tools; only the keeper's own settings determine them."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from backend.sessions.keeper.processors import of_containers

if TYPE_CHECKING:
    from collections.abc import Mapping

PREFIX: Final = "BT_STUDIO_SESSION_"
TOOLS_PREFIX: Final = "BT_STUDIO_TOOLS_"
TOKEN_VARIABLE: Final = "BT_STUDIO_MANAGER_TOKEN"  # noqa: S105 - the name, not the token
GATE_FOLDER: Final = "/run/bt-studio"
SESSION_LABEL: Final = "org.bt-studio.session"
TOOLS_LABEL: Final = "org.bt-studio.tools"
STACK_LABEL: Final = "org.bt-studio.stack"
USER: Final = "10001:10001"
PORT: Final = 7163
CPU_SHARES: Final = 256
"""The weight of a container; the server's containers have 1024 each, so answers come before robots."""
MEBIBYTE: Final = 1024 * 1024
PROFILE: Final = Path(__file__).with_name("seccomp.json")


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of one container; each can be set by a variable `BT_STUDIO_SESSION_<NAME>`.

    Attributes:
        cpus: processor cores.
        memory_mb: memory of all processes, and of the files, which are in memory too.
        pids: processes and threads.
        disk_mb: files below `/tmp`.
        shm_mb: shared memory, through which ROS nodes exchange messages.
        hours: the longest time for which the container may run.
    """

    cpus: float = 1.5
    memory_mb: float = 2048
    pids: float = 256
    disk_mb: float = 256
    shm_mb: float = 256
    hours: float = 12

    def overridden(self, environment: Mapping[str, str], prefix: str = PREFIX) -> Limits:
        """Returns these limits, with the changes that the environment makes.

        Raises:
            ValueError: a variable is not a positive number; the text names it.
        """
        given = {}
        for field in fields(self):
            name = prefix + field.name.upper()
            if text := environment.get(name, "").strip():
                try:
                    given[field.name] = float(text)
                except ValueError:
                    raise ValueError(f"{name}: {text!r} is not a number") from None
                if not 0 < given[field.name] < 1e6:
                    raise ValueError(f"{name}: {text!r} is not between 0 and a million")
        return replace(self, **given)


# The language servers of one user's open editors take some 200 MB each.
TOOLS_LIMITS: Final = Limits(cpus=1, memory_mb=1536, pids=128, disk_mb=128, shm_mb=1, hours=24)


@lru_cache(maxsize=1)
def seccomp_profile() -> str:
    """Returns the profile (JSON) of the system calls that a container may make.

    They are those that Docker's default profile of 2025 allows a program without capabilities, except for
    calls that no robot needs: asynchronous I/O in the kernel (`io_uring`, `io_setup`), tracing of other
    processes, 32-bit programs, and sockets of families other than Unix, IP and netlink. Older versions of
    Docker allow `io_uring` and AF_VSOCK, which leads to the host.
    """
    profile = json.loads(PROFILE.read_text(encoding="utf-8"))
    return json.dumps(profile, separators=(",", ":"))


@dataclass(frozen=True, slots=True)
class Plan:
    """The settings with which this keeper makes containers.

    Attributes:
        image: the executor's image.
        gate_source: the volume, or the folder of the host, with the gate's doors.
        stack: the name that distinguishes the containers of this keeper from those of another.
        grace_s: seconds for which a session without clients lives.
        hold_minutes: minutes for which a debugger may hold a tree; 0 is without limit.
        tools_grace_s: seconds for which a user's tools stay while no editor is open.
        processors: the numbers of the processors on which containers run; if empty, Docker chooses them.
    """

    image: str
    gate_source: str
    stack: str
    grace_s: float = 300
    limits: Limits = Limits()
    tools_grace_s: float = 600
    tools_limits: Limits = TOOLS_LIMITS
    processors: tuple[int, ...] = ()
    hold_minutes: float = 15

    def container_name(self, session_id: str) -> str:
        """Returns the name of a session's container."""
        return f"{self.stack}-session-{session_id}"

    def tools_name(self, tools_id: str) -> str:
        """Returns the name of the container with a user's tools."""
        return f"{self.stack}-tools-{tools_id}"

    def container(self, session_id: str, token: str, domain_id: int, door: str) -> dict[str, Any]:
        """Returns the container of a session for Docker's API; the session receives its socket at `door`."""
        limits = self.limits
        command = [
            *("--host", "127.0.0.1", "--port", str(PORT), "--token-env", TOKEN_VARIABLE),
            *("--gate", f"{GATE_FOLDER}/{door}", "--session", session_id),
            *("--domain-id", str(domain_id), "--grace", str(self.grace_s)),
        ]
        # A program that takes too much gets an error before the kernel ends the whole session.
        program_mb = max(64, int(limits.memory_mb * 0.6))
        environment = [
            f"BT_STUDIO_APPLICATION_MEMORY_MB={program_mb}",
            f"BT_STUDIO_EVALUATION_MEMORY_MB={program_mb}",
            f"BT_STUDIO_APPLICATION_FILE_MB={max(1, int(limits.disk_mb))}",
            f"BT_STUDIO_APPLICATION_PROCESSES={max(8, int(limits.pids / 4))}",
            f"BT_STUDIO_HOLD_MINUTES={self.hold_minutes:g}",
        ]
        made = self._confined(token, limits, {SESSION_LABEL: session_id})
        return made | {"Cmd": command, "Env": made["Env"] + environment}

    def tools(self, tools_id: str, token: str, door: str) -> dict[str, Any]:
        """Returns the container for Docker's API that reads the files of one user for the editor."""
        command = [
            *("--gate", f"{GATE_FOLDER}/{door}", "--session", tools_id),
            *("--token-env", TOKEN_VARIABLE, "--grace", str(self.tools_grace_s)),
        ]
        made = self._confined(token, self.tools_limits, {TOOLS_LABEL: tools_id})
        return made | {"Entrypoint": ["python", "-m", "executor.tools"], "Cmd": command}

    def _confined(self, token: str, limits: Limits, labels: dict[str, str]) -> dict[str, Any]:
        """Returns the settings of every container: no network, no privileges, and only memory to write to."""
        memory = int(limits.memory_mb * MEBIBYTE)
        return {
            "Image": self.image,
            "User": USER,
            "Env": [f"{TOKEN_VARIABLE}={token}"],
            "Labels": {STACK_LABEL: self.stack} | labels,
            "Healthcheck": {"Test": ["NONE"]},  # the keeper itself checks the number of processes
            "HostConfig": {
                "NetworkMode": "none",
                "ReadonlyRootfs": True,
                "CapDrop": ["ALL"],
                "SecurityOpt": ["no-new-privileges:true", f"seccomp={seccomp_profile()}"],
                "Privileged": False,
                "IpcMode": "private",
                "Init": True,
                "Memory": memory,
                "MemorySwap": memory,
                "CpuShares": CPU_SHARES,
                "CpusetCpus": ",".join(map(str, self.processors)),
                # Docker refuses to give more than the machine has.
                "NanoCpus": int(min(limits.cpus, len(self.processors) or os.cpu_count() or 1) * 1e9),
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
    """Returns the plan that the environment describes.

    Raises:
        ValueError: a variable has a value that cannot be used; the text names it.
    """
    return Plan(
        image=environment.get("BT_STUDIO_EXECUTOR_IMAGE") or "bt-studio-executor:latest",
        gate_source=gate_source,
        stack=stack,
        grace_s=_not_negative(environment, "BT_STUDIO_SESSION_GRACE_S", 300),
        limits=Limits().overridden(environment),
        tools_grace_s=_not_negative(environment, "BT_STUDIO_TOOLS_GRACE_S", 600),
        tools_limits=TOOLS_LIMITS.overridden(environment, TOOLS_PREFIX),
        processors=of_containers(environment),
        hold_minutes=_not_negative(environment, "BT_STUDIO_HOLD_MINUTES", 15),
    )


def _not_negative(environment: Mapping[str, str], name: str, default: float) -> float:
    text = environment.get(name, "").strip()
    try:
        found = float(text) if text else default
    except ValueError:
        raise ValueError(f"{name} is not a number") from None
    if not 0 <= found < 1e9:
        raise ValueError(f"{name}: {text!r} is not a number from 0 on")
    return found
