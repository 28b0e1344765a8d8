"""Checks the files of `docker/` without an engine."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess

import kubernetes_validate
import pytest
import yaml

from backend.config.environment import REMOVED, Environment
from tests.docker.engine import REPOSITORY
from tests.fakes.kubernetes_api import ALLOWED, ALLOWED_OF_EVALUATIONS

DOCKER = REPOSITORY / "docker"
OVERLAY_OF_ALL = DOCKER / "kubernetes" / "kustomization.yaml"
MANIFESTS = sorted(set((DOCKER / "kubernetes").glob("*.yaml")) - {OVERLAY_OF_ALL})
EVALUATIONS = DOCKER / "kubernetes-evaluations"
OVERLAY = DOCKER / "compose.proxy.yaml"
COMPOSE = sorted(set(DOCKER.glob("compose*.yaml")) - {OVERLAY})
KUBERNETES = "1.31.0"
GONE = {f"BT_STUDIO_{name}" for name in REMOVED} | {"BT_STUDIO_HOST_SESSIONS"}


@pytest.mark.parametrize("path", MANIFESTS, ids=lambda path: path.name)
def test_manifests_are_what_kubernetes_takes(path):
    for document in yaml.safe_load_all(path.read_text()):
        kubernetes_validate.validate(document, KUBERNETES, strict=True)


def test_one_command_applies_all_manifests():
    overlay = yaml.safe_load(OVERLAY_OF_ALL.read_text())
    (made,) = overlay["configMapGenerator"]
    assert {*overlay["resources"], *made["files"]} == {path.name for path in MANIFESTS}
    web = next(found for found in documents("web.yaml") if found["kind"] == "Deployment")
    pod = web["spec"]["template"]["spec"]
    assert {"name": "pod", "configMap": {"name": made["name"]}} in pod["volumes"]
    folder = next(m["mountPath"] for m in pod["containers"][0]["volumeMounts"] if m["name"] == "pod")
    defaults = [str(Environment.model_fields[name].default) for name in ("pod_template", "tools_template")]
    assert [f"{folder}/{name}" for name in made["files"]] == defaults


def test_what_is_applied_is_what_kubernetes_takes_with_the_templates_as_they_are():
    kubectl = shutil.which("kubectl")
    assert kubectl, "kubectl is missing: apt install kubernetes-client"
    command = [kubectl, "kustomize", str(DOCKER / "kubernetes")]
    rendered = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    found = list(yaml.safe_load_all(rendered))
    for document in found:
        kubernetes_validate.validate(document, KUBERNETES, strict=True)
    assert "evaluations" not in rendered, "they are sessions, unless kubernetes-evaluations is applied"
    (templates,) = (document for document in found if document["kind"] == "ConfigMap")
    assert templates["metadata"]["name"] == "bt-studio-pod"
    assert set(templates["data"]) == {"executor-pod.yaml", "tools-pod.yaml"}
    for name, text in templates["data"].items():
        assert yaml.safe_load(text) == yaml.safe_load((DOCKER / "kubernetes" / name).read_text())
    by_kind = {document["kind"]: document for document in found}
    web, scaler = by_kind["Deployment"], by_kind["HorizontalPodAutoscaler"]
    assert "replicas" not in web["spec"], "the autoscaler sets it"
    assert scaler["spec"]["scaleTargetRef"]["name"] == web["metadata"]["name"]


def test_the_overlay_of_evaluations_adds_a_closed_namespace_the_template_and_the_setting():
    command = [shutil.which("kubectl"), "kustomize", str(EVALUATIONS)]
    rendered = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    found = list(yaml.safe_load_all(rendered))
    for document in found:
        kubernetes_validate.validate(document, KUBERNETES, strict=True)
    (templates,) = (document for document in found if document["kind"] == "ConfigMap")
    file = EVALUATIONS / "evaluation-rayjob.yaml"
    assert set(templates["data"]) == {"executor-pod.yaml", "tools-pod.yaml", file.name}
    assert list(yaml.safe_load_all(templates["data"][file.name])) == list(
        yaml.safe_load_all(file.read_text())
    )
    assert Environment.model_fields["rayjob_template"].default.name == file.name
    (web,) = (document for document in found if document["kind"] == "Deployment")
    assert {"name": "BT_STUDIO_EVALUATIONS", "value": "rayjob"} in web["spec"]["template"]["spec"][
        "containers"
    ][0]["env"]


def test_the_web_servers_may_do_in_the_namespace_of_evaluations_what_the_launcher_does_and_no_more():
    documents_ = list(yaml.safe_load_all((EVALUATIONS / "evaluations.yaml").read_text()))
    name = Environment.model_fields["evaluation_namespace"].default
    (namespace,) = (each for each in documents_ if each["kind"] == "Namespace")
    assert namespace["metadata"]["name"] == name
    assert namespace["metadata"]["labels"]["pod-security.kubernetes.io/enforce"] == "restricted"
    assert {each["metadata"]["namespace"] for each in documents_ if each["kind"] != "Namespace"} == {name}
    (role,) = (each for each in documents_ if each["kind"] == "Role")
    given = {(verb, kind) for rule in role["rules"] for verb in rule["verbs"] for kind in rule["resources"]}
    assert given == ALLOWED_OF_EVALUATIONS
    policies = {
        each["metadata"]["name"]: each["spec"] for each in documents_ if each["kind"] == "NetworkPolicy"
    }
    closed = policies["bt-studio-closed"]
    assert (closed["podSelector"], closed["ingress"], closed["egress"]) == ({}, [], [])
    ports = {port["port"] for rule in policies["bt-studio-heads"]["ingress"] for port in rule["ports"]}
    assert ports == {7163, 8265}
    names = {port["port"] for rule in policies["bt-studio-workers"]["egress"] for port in rule["ports"]}
    assert names == {53}


def test_the_images_of_all_pods_are_renamed_by_one_command():
    text = (REPOSITORY / "docs/how-to/run-on-kubernetes.md").read_text()
    pattern, replacement = re.search(r"sed -i 's#(.*)#(.*)#' ", text).groups()
    for name in ("web.yaml", "executor-pod.yaml", "tools-pod.yaml"):
        renamed = re.sub(
            pattern.replace(r"\(", "(").replace(r"\)", ")"),
            replacement,
            (DOCKER / "kubernetes" / name).read_text(),
        )
        images = re.findall(r"image: (.*)", renamed)
        assert images
        assert all(re.fullmatch(r"registry\.example/bt-studio-(web|executor):1", image) for image in images)


def test_the_web_servers_may_do_in_the_namespace_of_sessions_what_the_launcher_does_and_no_more():
    found = {document["kind"]: document for document in documents("sessions.yaml")}
    (rule,) = found["Role"]["rules"]
    assert {(verb, kind) for verb in rule["verbs"] for kind in rule["resources"]} == ALLOWED
    namespace = found["Namespace"]["metadata"]["name"]
    assert namespace == Environment.model_fields["pod_namespace"].default
    assert {found[kind]["metadata"]["namespace"] for kind in ("Role", "RoleBinding", "NetworkPolicy")} == {
        namespace
    }
    assert found["NetworkPolicy"]["spec"]["egress"] == []


def documents(name):
    return list(yaml.safe_load_all((DOCKER / "kubernetes" / name).read_text()))


@pytest.mark.parametrize("path", COMPOSE, ids=lambda path: path.name)
def test_compose_files_start_with_old_and_new_compose(path):
    document = yaml.safe_load(path.read_text())
    assert set(document) <= {"version", "services", "networks", "volumes", "x-logging"}
    sockets = [name for name, service in document["services"].items() if "docker.sock" in str(service)]
    assert sockets == ["keeper"]
    for name in ("keeper", "gate"):
        assert document["services"][name]["network_mode"] == "none"
    for name in ("web", "keeper", "gate"):
        service = document["services"][name]
        assert (service["read_only"], service["cap_drop"]) == (True, ["ALL"])
        assert "privileged" not in service
    for name, service in document["services"].items():
        assert {"mem_limit", "pids_limit", "ulimits"} <= service.keys(), name
    mounts = {name: str(service.get("volumes")) for name, service in document["services"].items()}
    # Sessions and the gate share the doors; keeper and gate alone share the control socket.
    assert [name for name in mounts if "doors:" in mounts[name]] == ["keeper", "gate"]
    assert [name for name in mounts if "control:" in mounts[name]] == ["keeper", "gate"]
    assert "sockets:" not in mounts["gate"]


def test_only_caddy_publishes_ports_unless_a_proxy_takes_its_place():
    services = yaml.safe_load((DOCKER / "compose.yaml").read_text())["services"]
    assert [name for name, service in services.items() if "ports" in service] == ["caddy"]
    assert services["web"]["environment"]["BT_STUDIO_PROXY_HOPS"] == "1"
    caddy = services["caddy"]
    assert (caddy["read_only"], caddy["cap_drop"], "cap_add" in caddy) == (True, ["ALL"], False)
    assert {"mem_limit", "pids_limit", "ulimits"} <= set(caddy)
    variant = yaml.safe_load(OVERLAY.read_text())["services"]
    assert set(variant) == {"web", "caddy"}
    assert variant["web"]["ports"]
    assert variant["caddy"] == {"profiles": ["without-a-proxy"]}


def test_each_variable_of_the_compose_files_is_explained_in_the_example():
    text = (DOCKER / "compose.yaml").read_text() + OVERLAY.read_text()
    asked = set(re.findall(r"\$\{(BT_STUDIO_\w+)", text))
    explained = set(re.findall(r"(?m)^#? ?(BT_STUDIO_\w+)=", (DOCKER / ".env.example").read_text()))
    assert asked - explained == GONE, "settings of earlier releases, which the programs refuse by name"


@pytest.mark.parametrize("name", ["web", "executor"])
def test_the_images_leave_out_packages_that_are_in_the_lock(name):
    spec = importlib.util.spec_from_file_location("without", DOCKER / "without.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    lock = (REPOSITORY / "requirements.lock").read_text()
    patterns = module.read_patterns((DOCKER / f"{name}.without").read_text())
    left = module.without(lock, patterns)
    assert ("pybullet==" in left) == (name == "executor")
    assert ("\nros-rclpy==" in left) == (name == "executor")
    assert ("\ndjango==" in left) == (name == "web")
    assert ("\nuvicorn==" in left) == (name == "web")
    # The container that reads users' Python does not have the database's password.
    assert ("\nty==" in left) == ("\nruff==" in left) == (name == "executor")
    assert left.count("--hash=sha256:") > 100
