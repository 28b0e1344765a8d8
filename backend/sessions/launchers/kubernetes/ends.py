"""Reads from a pod whether its manager listens, and why it does not start or has ended. Pure.

The reasons are those that Kubernetes 1.31 writes: the phase and the reason of the pod, its conditions
`PodScheduled`, `Ready` and `DisruptionTarget`, and the state of its container.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Final

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes.bodies import DIGEST, PORT

if TYPE_CHECKING:
    from lightkube.models.core_v1 import ContainerState, PodCondition, PodStatus
    from lightkube.resources.core_v1 import Pod

__all__ = ["OF_WAITING", "Cause", "Seen", "Trouble", "address_of", "read_pod"]


class Cause(Enum):
    """Why a pod does not start, or has ended; the value is the sentence for the user."""

    NO_ROOM = "The cluster has no room for another session now."
    IMAGE = "The image of the session cannot be pulled."
    CONFIG = "The container of the session cannot be made."
    MEMORY = "The session took more memory than it may have."
    EVICTED = "The cluster ended the session, to keep its node alive."
    PREEMPTED = "The cluster gave the session's place to something more important."
    NODE_LOST = "The machine on which the session ran is gone."
    DEADLINE = "The session reached the longest time that it may run."
    DELETED = "Somebody deleted the session in the cluster."
    JOB_FAILED = "The program of the evaluation's RayJob failed."
    JOB_INVALID = "The KubeRay operator refuses the RayJob of the evaluation."
    JOB_LATE = "The evaluation reached the longest time that its RayJob may run."
    JOB_LOST = "The KubeRay operator lost the evaluation's Ray cluster."
    JOB_PODS = "The cluster refuses the pods of the evaluation."

    @property
    def is_final(self) -> bool:
        """Whether waiting does not help a pod that has not started."""
        return self not in (Cause.NO_ROOM, Cause.CONFIG)


@dataclass(frozen=True, slots=True)
class Trouble:
    """A cause, and what Kubernetes says of it."""

    cause: Cause
    detail: str = ""

    @property
    def text(self) -> str:
        """The sentence for the user, with Kubernetes' own words."""
        return f"{self.cause.value} ({self.detail})" if self.detail else self.cause.value


@dataclass(frozen=True, slots=True)
class Seen:
    """The last known state of a pod.

    Attributes:
        address: its address in the cluster; "" before it has one.
        digest: the SHA-256 of its certificate.
        is_ready: whether its manager listens.
        exit_status: how its container ended, or `UNKNOWN_EXIT`; None while it has not.
        lacks: what it waits for before it is ready, if that is known.
    """

    uid: str
    address: str = ""
    digest: str = ""
    is_ready: bool = False
    exit_status: int | None = None
    trouble: Trouble | None = None
    lacks: str = ""

    @property
    def is_decided(self) -> bool:
        """Whether it is known if a pod that starts will be ready."""
        hopeless = self.trouble is not None and self.trouble.cause.is_final
        return self.is_ready or self.exit_status is not None or hopeless


_OF_REASONS: Final = {
    "Evicted": Cause.EVICTED,
    "NodeLost": Cause.NODE_LOST,
    "NodeShutdown": Cause.NODE_LOST,
    "Terminated": Cause.NODE_LOST,  # by the shutdown of its node
    "Shutdown": Cause.NODE_LOST,
    "DeadlineExceeded": Cause.DEADLINE,
    "OutOfcpu": Cause.NO_ROOM,
    "OutOfmemory": Cause.NO_ROOM,
    "OutOfpods": Cause.NO_ROOM,
    "PreemptionByScheduler": Cause.PREEMPTED,
    "DeletionByTaintManager": Cause.NODE_LOST,
    "DeletionByPodGC": Cause.NODE_LOST,
    "EvictionByEvictionAPI": Cause.EVICTED,
    "TerminationByKubelet": Cause.EVICTED,
}
"""Causes by the reason of a pod's status, and of its condition `DisruptionTarget`."""
OF_WAITING: Final = {
    "ImagePullBackOff": Cause.IMAGE,
    "InvalidImageName": Cause.IMAGE,
    "ErrImageNeverPull": Cause.IMAGE,
    "CreateContainerConfigError": Cause.CONFIG,
    "CreateContainerError": Cause.CONFIG,
    "RunContainerError": Cause.CONFIG,
}
"""Causes by the reason for which a container waits; the first error of a pull is tried again by the node."""
_ENDED: Final = frozenset({"Failed", "Succeeded"})


def read_pod(pod: Pod) -> Seen:
    """Returns what a pod says of itself."""
    metadata, status = pod.metadata, pod.status
    uid = (metadata.uid if metadata else None) or ""
    digest = (metadata.annotations or {}).get(DIGEST, "") if metadata else ""
    if status is None:
        return Seen(uid, digest=digest)
    conditions = {condition.type: condition for condition in status.conditions or []}
    state = _container(status)
    is_lost = bool(metadata and metadata.deletionTimestamp) and "DisruptionTarget" in conditions
    has_ended = status.phase in _ENDED or bool(state and state.terminated) or is_lost
    ready = conditions.get("Ready")
    return Seen(
        uid=uid,
        address=status.podIP or "",
        digest=digest,
        is_ready=not has_ended and ready is not None and ready.status == "True",
        exit_status=_exit_status(state) if has_ended else None,
        trouble=_trouble(status, conditions, state),
    )


def _container(status: PodStatus) -> ContainerState | None:
    return status.containerStatuses[0].state if status.containerStatuses else None


def _exit_status(state: ContainerState | None) -> int:
    return state.terminated.exitCode if state and state.terminated else UNKNOWN_EXIT


def _trouble(
    status: PodStatus, conditions: dict[str, PodCondition], state: ContainerState | None
) -> Trouble | None:
    if cause := _OF_REASONS.get(status.reason or ""):
        return Trouble(cause, status.message or "")
    disruption = conditions.get("DisruptionTarget")
    if disruption and (cause := _OF_REASONS.get(disruption.reason or "")):
        return Trouble(cause, disruption.message or "")
    if state and state.terminated:
        return Trouble(Cause.MEMORY) if state.terminated.reason == "OOMKilled" else None
    if state and state.waiting and (cause := OF_WAITING.get(state.waiting.reason or "")):
        return Trouble(cause, state.waiting.message or "")
    scheduled = conditions.get("PodScheduled")
    if scheduled and scheduled.status == "False" and scheduled.reason == "Unschedulable":
        return Trouble(Cause.NO_ROOM, scheduled.message or "")
    return None


def address_of(seen: Seen) -> str:
    """Returns the address of the manager in a pod, with the digest of its certificate."""
    host = f"[{seen.address}]" if ":" in seen.address else seen.address
    return f"wss://{host}:{PORT}#{seen.digest}"
