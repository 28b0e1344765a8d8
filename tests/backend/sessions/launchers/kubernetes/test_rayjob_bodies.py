"""RayJobs as they are made of the template that we ship, and what is read from their status."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import jsonschema
import kubernetes_validate
import pytest
import yaml

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes.bodies import TemplateError
from backend.sessions.launchers.kubernetes.ends import Cause, Trouble
from backend.sessions.launchers.kubernetes.rayjob_bodies import (
    job_body,
    policy_body,
    rayjob_name,
    read_job_template,
    read_rayjob,
)
from tests.backend.sessions.launchers.kubernetes.conftest import JOB_TEMPLATE
from tests.fakes import kuberay

TEXT = JOB_TEMPLATE.read_text()
SESSION = "0b0b0b0b-0000-4000-8000-000000000000"


def changed(change: Any) -> str:
    """Returns the template with a change to its RayJob and its policy."""
    job, policy = yaml.safe_load_all(TEXT)
    change(job, policy)
    return yaml.safe_dump_all([job, policy])


def seen(status: dict[str, Any] | None, *, deleted: bool = False) -> Any:
    metadata = SimpleNamespace(
        uid="u", annotations={"bt-studio/certificate": "d"}, deletionTimestamp="now" if deleted else None
    )
    return read_rayjob(SimpleNamespace(metadata=metadata, status=status))


def test_the_template_makes_what_kuberay_and_kubernetes_take() -> None:
    template = read_job_template(TEXT)
    job = job_body(template, SESSION, "d1gest")
    kuberay.validate(job)
    pods = kuberay.pods_of(job)
    assert len(pods) == 2
    policy = policy_body(template, SESSION, "the uid")
    for document in (*pods, policy):
        kubernetes_validate.validate(document, "1.31.0", strict=True)
    name = rayjob_name(SESSION)
    assert job["metadata"]["labels"] == {
        "app": "bt-studio-evaluation",
        "bt-studio/kind": "evaluation",
        "bt-studio/evaluation": SESSION,
    }
    assert job["metadata"]["annotations"] == {"bt-studio/certificate": "d1gest"}
    assert policy["metadata"]["ownerReferences"][0] | {"uid": 0} == {
        "apiVersion": "ray.io/v1",
        "kind": "RayJob",
        "name": name,
        "uid": 0,
    }
    assert "SESSION" not in str(job) + str(policy)


def test_the_template_is_bounded_and_closed() -> None:
    job = job_body(read_job_template(TEXT), SESSION, "d")
    spec = job["spec"]
    assert spec["activeDeadlineSeconds"] > 0
    assert spec["shutdownAfterJobFinishes"] is True
    assert spec["ttlSecondsAfterFinished"] > 0
    assert spec["backoffLimit"] == 0
    assert spec["rayClusterSpec"]["authOptions"] == {"mode": "token"}
    assert spec["rayClusterSpec"]["enableInTreeAutoscaling"] is False
    for pod in kuberay.pods_of(job):
        assert pod["spec"]["automountServiceAccountToken"] is False
        (container,) = pod["spec"]["containers"]
        assert {"cpu", "memory", "ephemeral-storage"} <= container["resources"]["limits"].keys()
        assert container["securityContext"]["readOnlyRootFilesystem"] is True
        assert {"readinessProbe", "livenessProbe"} <= container.keys(), "KubeRay's own ones need wget"
        assert all("emptyDir" in each or "secret" in each for each in pod["spec"]["volumes"])
    worker = kuberay.pods_of(job)[1]
    assert rayjob_name(SESSION) not in str(worker["spec"]), "a worker runs users' code and needs no secret"


def test_the_pods_of_one_evaluation_reach_each_other_alone() -> None:
    template = read_job_template(TEXT)
    mine, other = (policy_body(template, each, "u")["spec"] for each in ("s1", "s2"))
    peers = [{"podSelector": mine["podSelector"]}]
    assert mine["ingress"] == [{"from": peers}]
    assert mine["egress"] == [{"to": peers}]
    assert mine["podSelector"] != other["podSelector"]
    for pod in kuberay.pods_of(job_body(template, "s1", "d")):
        assert mine["podSelector"]["matchLabels"].items() <= pod["metadata"]["labels"].items()


def without_secret(job: dict[str, Any], _: object) -> None:
    spec = job["spec"]["rayClusterSpec"]["headGroupSpec"]["template"]["spec"]
    spec["containers"][0]["env"] = []
    spec["volumes"] = []


def without_workers(job: dict[str, Any], _: object) -> None:
    job["spec"]["rayClusterSpec"]["workerGroupSpecs"] = []


def head_of(job: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = job["spec"]["rayClusterSpec"]["headGroupSpec"]["template"]
    return found


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("{", "it is not YAML"),
        ("- 1", "does not hold one RayJob"),
        ("", "does not hold one RayJob"),
        (TEXT.partition("---")[0], "does not hold one RayJob"),
        (lambda job, _: job["spec"].pop("entrypoint"), "no entrypoint"),
        (
            lambda job, _: job["spec"]["rayClusterSpec"].pop("workerGroupSpecs"),
            "no group of workers",
        ),
        (lambda job, _: job.update(spec=["a"]), "of the wrong kind"),
        (without_secret, "does not name the secret SESSION"),
        (
            lambda job, _: head_of(job)["spec"].update(hostNetwrk=True),
            r"no field spec\.hostNetwrk of",
        ),
        (lambda job, _: head_of(job)["spec"].update(containers=[]), "does not have one container"),
        (
            lambda job, _: head_of(job)["metadata"].pop("labels"),
            "not select the pods of its head",
        ),
        (lambda _, policy: policy["spec"].update(podSelector={}), "selects by no label SESSION"),
        (
            lambda _, policy: policy["spec"].update(egres=[]),
            r"no field spec\.egres of its NetworkPolicy",
        ),
    ],
)
def test_what_is_no_template_is_refused_with_its_place(text: Any, sentence: str) -> None:
    with pytest.raises(TemplateError, match=sentence):
        read_job_template(text if isinstance(text, str) else changed(text))


@pytest.mark.parametrize(
    "change",
    [
        {"ttlSecondsAfterFinishd": 3},
        {"submissionMode": "Fax"},
        {"activeDeadlineSeconds": -1},
        {"shutdownAfterJobFinishes": False},
        {"backoffLimit": "none"},
    ],
)
def test_the_schema_of_the_tests_refuses_what_kuberay_refuses(change: dict[str, Any]) -> None:
    job = job_body(read_job_template(TEXT), SESSION, "d")
    job["spec"].update(change)
    with pytest.raises(jsonschema.ValidationError):
        kuberay.validate(job)


def test_what_runs_is_ready_at_the_address_of_its_head() -> None:
    found = seen(kuberay.running("10.1.2.3"))
    assert (found.uid, found.digest, found.address, found.is_ready) == ("u", "d", "10.1.2.3", True)
    assert (found.exit_status, found.trouble) == (None, None)
    assert not seen(kuberay.running("")).is_ready


def condition(kind: str, status: str, reason: str, message: str = "") -> dict[str, Any]:
    found = {"type": kind, "status": status, "reason": reason, "message": message}
    return {"jobDeploymentStatus": "Initializing", "rayClusterStatus": {"conditions": [found]}}


@pytest.mark.parametrize(
    ("status", "exit_status", "trouble"),
    [
        ({"jobDeploymentStatus": "Complete", "jobStatus": "SUCCEEDED"}, 0, None),
        ({"jobStatus": "STOPPED"}, UNKNOWN_EXIT, None),
        (
            {"jobDeploymentStatus": "Failed", "reason": "DeadlineExceeded", "message": "1 h"},
            UNKNOWN_EXIT,
            Trouble(Cause.JOB_LATE, "1 h"),
        ),
        (
            {"jobDeploymentStatus": "Failed", "jobStatus": "FAILED", "reason": "AppFailed"},
            UNKNOWN_EXIT,
            Trouble(Cause.JOB_FAILED),
        ),
        (
            {"jobDeploymentStatus": "Failed", "reason": "JobStatusCheckTimeoutExceeded"},
            UNKNOWN_EXIT,
            Trouble(Cause.JOB_LOST),
        ),
        (
            {"jobDeploymentStatus": "ValidationFailed", "reason": "ValidationFailed", "message": "no head"},
            UNKNOWN_EXIT,
            Trouble(Cause.JOB_INVALID, "no head"),
        ),
        (
            condition("HeadPodReady", "False", "ImagePullBackOff", "no tag"),
            None,
            Trouble(Cause.IMAGE, "no tag"),
        ),
        (condition("HeadPodReady", "False", "ContainersNotReady"), None, None),
        (condition("HeadPodReady", "False", "OOMKilled"), None, Trouble(Cause.MEMORY)),
        (
            condition("ReplicaFailure", "True", "FailedCreateHeadPod", "exceeded quota: x"),
            None,
            Trouble(Cause.NO_ROOM, "exceeded quota: x"),
        ),
        (
            condition("ReplicaFailure", "True", "FailedCreateHeadPod", "violates PodSecurity"),
            None,
            Trouble(Cause.JOB_PODS, "violates PodSecurity"),
        ),
        (None, None, None),
        ({"jobStatus": 3}, None, None),
    ],
)
def test_each_status_has_its_end_and_its_reason(
    status: dict[str, Any] | None, exit_status: int | None, trouble: Trouble | None
) -> None:
    found = seen(status)
    assert (found.exit_status, found.trouble, found.is_ready) == (exit_status, trouble, False)


def test_a_rayjob_that_is_deleted_has_ended() -> None:
    assert seen(kuberay.running(), deleted=True).exit_status == UNKNOWN_EXIT


def test_what_a_start_waits_for_is_known() -> None:
    assert "has not taken it up" in seen(None).lacks
    found = condition("HeadPodReady", "False", "ContainersNotReady")
    found["rayClusterStatus"] |= {"readyWorkerReplicas": 1, "desiredWorkerReplicas": 4}
    assert seen(found).lacks == "its head is not ready (ContainersNotReady), and 1 of 4 workers are ready"
