"""The part of KubeRay that concerns RayJobs: schema, further rules, and an operator."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jsonschema

if TYPE_CHECKING:
    from tests.fakes.kubernetes_api import FakeCluster

GROUP = "ray.io"
LONGEST_NAME = 47
_SCHEMA = jsonschema.Draft202012Validator(
    json.loads(Path(__file__).with_name("rayjob.json").read_text(encoding="utf-8"))
)


def validate(job: dict[str, Any]) -> None:
    """Refuses what the API server refuses by the schema of RayJobs, and what the operator calls invalid."""
    _SCHEMA.validate(job)
    spec = job["spec"]
    wrong = []
    if len(job["metadata"]["name"]) > LONGEST_NAME:
        wrong.append(f"the name has more than {LONGEST_NAME} characters")
    if spec.get("ttlSecondsAfterFinished") and not spec.get("shutdownAfterJobFinishes"):
        wrong.append("ttlSecondsAfterFinished needs shutdownAfterJobFinishes")
    if spec.get("activeDeadlineSeconds", 1) <= 0:
        wrong.append("activeDeadlineSeconds must be positive")
    if spec.get("submissionMode", "K8sJobMode") not in {"K8sJobMode", "HTTPMode", "SidecarMode"}:
        wrong.append("submissionMode")
    for group in spec["rayClusterSpec"].get("workerGroupSpecs", []):
        if not group["minReplicas"] <= group.get("replicas", group["minReplicas"]) <= group["maxReplicas"]:
            wrong.append(f"replicas of {group['groupName']}")
    if wrong:
        raise jsonschema.ValidationError("; ".join(wrong))


def pods_of(job: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns the pods of a RayJob, as the operator makes them of the templates."""
    cluster = job["spec"]["rayClusterSpec"]
    groups = [cluster["headGroupSpec"], *cluster["workerGroupSpecs"]]
    return [{"apiVersion": "v1", "kind": "Pod", **group["template"]} for group in groups]


def running(address: str = "127.0.0.1") -> dict[str, Any]:
    """Returns the status of a RayJob whose program runs on a head with an address."""
    return {
        "jobDeploymentStatus": "Running",
        "jobStatus": "RUNNING",
        "rayClusterStatus": {
            "head": {"podIP": address},
            "readyWorkerReplicas": 2,
            "desiredWorkerReplicas": 2,
        },
    }


def make_running(cluster: FakeCluster, job: dict[str, Any]) -> None:
    """Does what the operator does with a RayJob that starts as it should."""
    cluster.set_status(job["metadata"]["name"], "rayjobs", jobDeploymentStatus="Initializing")
    cluster.set_status(job["metadata"]["name"], "rayjobs", **running())
