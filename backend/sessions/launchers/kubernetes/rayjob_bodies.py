"""Makes RayJobs from the template `evaluation-rayjob.yaml`, and reads what KubeRay says of them. Pure.

The template holds a RayJob and the network policy of its pods. Of both only names are replaced, so that what
an administrator has reviewed and bounded is what runs. The words are those of KubeRay 1.5 to 1.7.
"""

from __future__ import annotations

import copy
from typing import Any, Final, NamedTuple

import msgspec
import yaml
from lightkube.generic_resource import create_namespaced_resource
from lightkube.models.core_v1 import PodTemplateSpec
from lightkube.resources.networking_v1 import NetworkPolicy

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes.asking import QUOTA
from backend.sessions.launchers.kubernetes.bodies import (
    DIGEST,
    KIND_LABEL,
    ObjectKind,
    TemplateError,
    lost_field,
    owner_of,
    renamed,
)
from backend.sessions.launchers.kubernetes.ends import OF_WAITING, Cause, Seen, Trouble

__all__ = [
    "EVALUATION",
    "ID_LABEL",
    "JOB",
    "JobTemplate",
    "RayJob",
    "job_body",
    "policy_body",
    "rayjob_name",
    "read_job_template",
    "read_rayjob",
]

RayJob: Final[type[Any]] = create_namespaced_resource("ray.io", "v1", "RayJob", "rayjobs")
JOB: Final = ObjectKind("ray.io/v1", "RayJob")
EVALUATION: Final = "evaluation"
"""What the label of our objects says of a RayJob."""
ID_LABEL: Final = "bt-studio/evaluation"
"""The label with the id of the session for which a RayJob was made."""
_POLICY: Final = ("networking.k8s.io/v1", "NetworkPolicy")
_READY: Final = "RUNNING"
_ENDED: Final = frozenset({"Complete", "Failed", "ValidationFailed", "STOPPED", "SUCCEEDED", "FAILED"})
_OF_REASONS: Final = {
    "AppFailed": Cause.JOB_FAILED,
    "DeadlineExceeded": Cause.JOB_LATE,
    "JobDeploymentStatusTransitionGracePeriodExceeded": Cause.JOB_LOST,
    "JobStatusCheckTimeoutExceeded": Cause.JOB_LOST,
    "PreRunningDeadlineExceeded": Cause.NO_ROOM,
    "SubmissionFailed": Cause.JOB_LOST,
    "ValidationFailed": Cause.JOB_INVALID,
}
_OF_HEADS: Final = {**OF_WAITING, "OOMKilled": Cause.MEMORY}


class JobTemplate(NamedTuple):
    """A RayJob, and the network policy of its pods."""

    job: dict[str, Any]
    policy: dict[str, Any]


class _Condition(msgspec.Struct):
    type: str = ""
    status: str = ""
    reason: str = ""
    message: str = ""


class _Head(msgspec.Struct):
    pod_ip: str = msgspec.field(name="podIP", default="")


class _Cluster(msgspec.Struct, rename="camel"):
    head: _Head = msgspec.field(default_factory=_Head)
    conditions: list[_Condition] = []
    ready_worker_replicas: int = 0
    desired_worker_replicas: int = 0


class _Status(msgspec.Struct, rename="camel"):
    job_deployment_status: str = ""
    job_status: str = ""
    reason: str = ""
    message: str = ""
    ray_cluster_status: _Cluster = msgspec.field(default_factory=_Cluster)


msgspec.convert({}, _Status)  # msgspec does not end if two threads meet a type for the first time


def rayjob_name(session_id: str) -> str:
    """Returns the name of the RayJob of a session; KubeRay takes 47 characters."""
    return f"bt-studio-{session_id}"


def read_job_template(text: str) -> JobTemplate:
    """Returns the template that a YAML file holds.

    Raises:
        TemplateError: it is no RayJob with a network policy for all of its pods.
    """
    try:
        documents = [each for each in yaml.safe_load_all(text) if each is not None]
    except yaml.YAMLError as error:
        raise TemplateError(f"it is not YAML: {error}") from error
    kinds = {(each.get("apiVersion"), each.get("kind")): each for each in documents if isinstance(each, dict)}
    if len(documents) != 2 or set(kinds) != {JOB, _POLICY}:
        raise TemplateError(
            "it does not hold one RayJob (apiVersion: ray.io/v1) and one NetworkPolicy "
            "(apiVersion: networking.k8s.io/v1)"
        )
    found = JobTemplate(kinds[JOB], kinds[_POLICY])
    try:
        _check_policy(found.policy)
        _check_job(found)
    except (AttributeError, TypeError) as error:
        raise TemplateError(f"a part of it is of the wrong kind: {error}") from error
    return found


def job_body(template: JobTemplate, session_id: str, digest: str) -> dict[str, Any]:
    """Returns a RayJob; `digest` is the SHA-256 of the certificate that will be in its secret."""
    name = rayjob_name(session_id)
    body: dict[str, Any] = renamed(copy.deepcopy(template.job), name)
    metadata = body.setdefault("metadata", {})
    metadata["name"] = name
    metadata["labels"] = {**metadata.get("labels", {}), KIND_LABEL: EVALUATION, ID_LABEL: session_id}
    metadata["annotations"] = {**metadata.get("annotations", {}), DIGEST: digest}
    return body


def policy_body(template: JobTemplate, session_id: str, uid: str) -> dict[str, Any]:
    """Returns the network policy of a RayJob, with which it goes; `uid` is that of the RayJob."""
    name = rayjob_name(session_id)
    body: dict[str, Any] = renamed(copy.deepcopy(template.policy), name)
    body["metadata"] = {
        **body.get("metadata", {}),
        "name": name,
        "ownerReferences": [owner_of(JOB, name, uid)],
    }
    return body


def read_rayjob(job: Any) -> Seen:
    """Returns what a RayJob says of itself; its manager may be asked as soon as it runs."""
    metadata = job.metadata
    uid = (metadata.uid if metadata else None) or ""
    digest = (metadata.annotations or {}).get(DIGEST, "") if metadata else ""
    try:
        status = msgspec.convert(job.status or {}, _Status)
    except msgspec.ValidationError:
        return Seen(uid, digest=digest)
    is_deleted = bool(metadata and metadata.deletionTimestamp)
    has_ended = is_deleted or bool({status.job_deployment_status, status.job_status} & _ENDED)
    address = status.ray_cluster_status.head.pod_ip
    return Seen(
        uid=uid,
        address=address,
        digest=digest,
        is_ready=not has_ended and status.job_status == _READY and bool(address),
        exit_status=(0 if status.job_status == "SUCCEEDED" else UNKNOWN_EXIT) if has_ended else None,
        trouble=_trouble(status),
        lacks=_lacks(status),
    )


# --- inside ---


def _check_policy(policy: dict[str, Any]) -> None:
    try:
        kept = msgspec.to_builtins(msgspec.convert(policy, NetworkPolicy))
    except msgspec.ValidationError as error:
        raise TemplateError(f"its NetworkPolicy is none: {error}") from error
    if lost := lost_field(policy, kept):
        raise TemplateError(f"Kubernetes knows no field {lost} of its NetworkPolicy")
    labels = _selected(policy)
    if renamed(labels, "") == labels:
        raise TemplateError("its NetworkPolicy selects by no label SESSION, and so more than one evaluation")


def _check_job(found: JobTemplate) -> None:
    spec = found.job.get("spec") or {}
    cluster = spec.get("rayClusterSpec") or {}
    head = cluster.get("headGroupSpec") or {}
    workers = cluster.get("workerGroupSpecs") or []
    if not spec.get("entrypoint"):
        raise TemplateError("its RayJob has no entrypoint")
    if not workers:
        raise TemplateError("its RayJob has no group of workers")
    groups = {"head": head} | {f"worker {number}": each for number, each in enumerate(workers)}
    for where, group in groups.items():
        _check_pod(where, group.get("template"), _selected(found.policy))
    if not _names_secret(head):
        raise TemplateError("its head does not name the secret SESSION, which holds token and certificate")


def _check_pod(where: str, template: Any, selected: dict[str, str]) -> None:
    try:
        kept = msgspec.to_builtins(msgspec.convert(template, PodTemplateSpec))
    except msgspec.ValidationError as error:
        raise TemplateError(f"the template of its {where} is no pod: {error}") from error
    if lost := lost_field(template, kept):
        raise TemplateError(f"Kubernetes knows no field {lost} of its {where}")
    if len((template.get("spec") or {}).get("containers") or []) != 1:
        raise TemplateError(f"the pod of its {where} does not have one container")
    labels = (template.get("metadata") or {}).get("labels") or {}
    if not selected.items() <= labels.items():
        raise TemplateError(f"its NetworkPolicy does not select the pods of its {where} by their labels")


def _selected(policy: dict[str, Any]) -> dict[str, str]:
    selector = (policy.get("spec") or {}).get("podSelector") or {}
    return dict(selector.get("matchLabels") or {})


def _names_secret(head: dict[str, Any]) -> bool:
    spec = head["template"]["spec"]
    return bool(renamed(spec, "") != spec)


def _trouble(status: _Status) -> Trouble | None:
    if cause := _OF_REASONS.get(status.reason):
        return Trouble(cause, status.message)
    for condition in status.ray_cluster_status.conditions:
        if condition.type == "ReplicaFailure" and condition.status == "True":
            cause = Cause.NO_ROOM if QUOTA in condition.message else Cause.JOB_PODS
            return Trouble(cause, condition.message)
        is_head = condition.type == "HeadPodReady" and condition.status != "True"
        if is_head and (cause := _OF_HEADS.get(condition.reason)):
            return Trouble(cause, condition.message)
    return None


def _lacks(status: _Status) -> str:
    if not status.job_deployment_status:
        return "the KubeRay operator has not taken it up: is it running, and does it watch this namespace?"
    found = status.ray_cluster_status
    heads = [each for each in found.conditions if each.type == "HeadPodReady" and each.status != "True"]
    head = f"its head is not ready ({heads[0].reason}), and " if heads else ""
    return f"{head}{found.ready_worker_replicas} of {found.desired_worker_replicas} workers are ready"
