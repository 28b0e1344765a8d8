"""The page about three machines with k3s: its manifests, its commands, and the pods that follow from them."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess

import kubernetes_validate
import pytest
import yaml

from backend.config.environment import Environment
from backend.sessions.launchers.kubernetes.bodies import Kind, pod_name, read_template
from backend.sessions.launchers.kubernetes.launcher import KubernetesLauncher
from backend.sessions.manager.certificate import make_certificate
from tests.backend.sessions.conftest import spec
from tests.backend.sessions.launchers.kubernetes.conftest import client_of
from tests.docker.engine import REPOSITORY
from tests.fakes.kubernetes_api import NAMESPACE, FakeCluster

PAGE = (REPOSITORY / "docs/how-to/run-on-kubernetes.md").read_text()
SECTION = PAGE.partition("\n## Three machines with k3s\n")[2].partition("\n## ")[0]
BLOCKS = re.findall(r"(?ms)^```(?:ba)?sh\n(.*?)^```", SECTION)
KUBERNETES = "1.31.0"
TRAEFIK = {
    "apiVersion": "v1",
    "kind": "Service",
    "metadata": {"name": "traefik", "namespace": "kube-system"},
    "spec": {"type": "LoadBalancer", "ports": [{"name": "web", "port": 80}]},
}


def block(start):
    """Returns the one block of commands with a line that starts so."""
    (found,) = [each for each in BLOCKS if re.search(rf"(?m)^{re.escape(start)}", each)]
    return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A copy of `docker/` in which step 3 of the page was done."""
    made = tmp_path_factory.mktemp("k3s")
    for name in ("kubernetes", "kubernetes-k3s"):
        shutil.copytree(REPOSITORY / "docker" / name, made / "docker" / name)
    subprocess.run(["bash", "-euc", block("cat > settings.env")], cwd=made, check=True)
    return made / "docker"


@pytest.fixture(scope="module")
def written(folder):
    return dict(line.split("=", 1) for line in (folder / "settings.env").read_text().splitlines())


def kubectl(*arguments, cwd):
    """Runs kubectl without a cluster; returns the objects that it writes."""
    program = shutil.which("kubectl")
    assert program, "kubectl is missing: apt install kubernetes-client"
    variables = {**os.environ, "KUBECONFIG": os.devnull}
    done = subprocess.run(
        [program, *arguments], cwd=cwd, env=variables, stdout=subprocess.PIPE, text=True, check=True
    )
    found = list(yaml.safe_load_all(done.stdout))
    for document in found:
        kubernetes_validate.validate(document, KUBERNETES, strict=True)
    return found


@pytest.fixture(scope="module")
def applied(folder):
    """The objects that the page applies, each of a form that Kubernetes takes."""
    assert "kubectl apply -k kubernetes-k3s\n" in block("kubectl apply")
    return kubectl("kustomize", "kubernetes-k3s", cwd=folder)


def of_kind(objects, kind, name):
    (found,) = [each for each in objects if (each["kind"], each["metadata"]["name"]) == (kind, name)]
    return found


def pods_of(objects):
    """Returns the pods of the objects, by their label."""
    templates = [each["spec"]["template"] for each in objects if "template" in each.get("spec", {})]
    return {each["metadata"]["labels"]["app"]: each["spec"] for each in templates}


def test_each_pod_may_do_as_little_as_a_web_server(applied):
    pods = pods_of(applied)
    assert set(pods) == {"bt-studio-web", "bt-studio-postgres", "bt-studio-redis"}
    for pod in pods.values():
        assert pod["securityContext"]["runAsNonRoot"]
        (container,) = pod["containers"]
        assert container["securityContext"] == {
            "allowPrivilegeEscalation": False,
            "readOnlyRootFilesystem": True,
            "capabilities": {"drop": ["ALL"]},
        }
        assert {"requests", "limits"} <= container["resources"].keys()


def test_the_programs_are_those_of_the_compose_file(applied):
    services = yaml.safe_load((REPOSITORY / "docker/compose.yaml").read_text())["services"]
    for name in ("postgres", "redis"):
        (container,) = pods_of(applied)[f"bt-studio-{name}"]["containers"]
        assert container["image"] == services[name]["image"]
        assert container.get("command") == services[name].get("command")


def test_services_and_policies_lead_to_the_pods(applied):
    ports = {name: pod["containers"][0]["ports"][0] for name, pod in pods_of(applied).items()}
    services = {each["metadata"]["name"]: each["spec"] for each in applied if each["kind"] == "Service"}
    for service in services.values():
        assert service["ports"][0]["targetPort"] == ports[service["selector"]["app"]]["name"]
    backend = of_kind(applied, "Ingress", "bt-studio")["spec"]["rules"][0]["http"]["paths"][0]["backend"]
    (port,) = services[backend["service"]["name"]]["ports"]
    assert backend["service"]["port"]["name"] == port["name"]
    policy = of_kind(applied, "NetworkPolicy", "bt-studio-storage")["spec"]
    (rule,) = policy["ingress"]
    behind = {name: port for name, port in ports.items() if name != "bt-studio-web"}
    assert set(policy["podSelector"]["matchExpressions"][0]["values"]) == set(behind)
    assert {port["port"] for port in rule["ports"]} == {port["containerPort"] for port in behind.values()}
    assert rule["from"] == [{"podSelector": {"matchLabels": {"app": "bt-studio-web"}}}]


def test_the_settings_are_those_of_a_server_for_a_team(written, applied, monkeypatch):
    password = written["POSTGRES_PASSWORD"]
    for name, text in {**written, "BT_STUDIO_MODE": "team", "BT_STUDIO_LAUNCHER": "kubernetes"}.items():
        monkeypatch.setenv(name, text)
    found = Environment()
    assert found.may_be_several
    assert found.public_url == f"https://{host_of(applied)}" == "https://my.example.org"
    database, redis = written["BT_STUDIO_DATABASE_URL"], written["BT_STUDIO_REDIS_URL"]
    assert database == f"postgresql://studio:{password}@bt-studio-postgres:5432/studio"
    assert redis == "redis://bt-studio-redis:6379/0"
    for name in ("bt-studio-postgres", "bt-studio-redis"):
        assert of_kind(applied, "Service", name)["metadata"]["namespace"] == "bt-studio"
    (postgres,) = pods_of(applied)["bt-studio-postgres"]["containers"]
    variables = {each["name"]: each for each in postgres["env"]}
    assert (variables["POSTGRES_USER"]["value"], variables["POSTGRES_DB"]["value"]) == ("studio", "studio")
    asked = variables["POSTGRES_PASSWORD"]["valueFrom"]["secretKeyRef"]
    assert asked == {"name": "bt-studio", "key": "POSTGRES_PASSWORD"}


def host_of(applied):
    ingress = of_kind(applied, "Ingress", "bt-studio")["spec"]
    (rule,), (tls,) = ingress["rules"], ingress["tls"]
    assert tls["hosts"] == [rule["host"]]
    return rule["host"]


def test_the_commands_of_the_server_are_what_kubectl_takes(folder, written, applied):
    made = make_certificate("my.example.org")
    (folder / "tls.crt").write_text(made.certificate)
    (folder / "tls.key").write_text(made.key)
    (folder / "traefik.yaml").write_text(json.dumps(TRAEFIK))
    objects = list(applied)
    for line in block("kubectl apply").splitlines():
        words = shlex.split(line)[1:]
        verb = words[2] if words[0] == "-n" else words[0]
        if verb == "create":
            objects += kubectl(*words, "--dry-run=client", "-o", "yaml", cwd=folder)
        elif verb == "patch":
            patch = words[words.index("-p") :]
            (service,) = kubectl("patch", "--local", "-f", "traefik.yaml", *patch, "-o", "yaml", cwd=folder)
            assert service["spec"]["externalTrafficPolicy"] == "Local"
        elif verb in {"rollout", "exec"}:
            kind, name = next(word for word in words if "/" in word).split("/")
            assert of_kind(objects, kind.capitalize(), name)
        else:
            assert verb == "apply", line
    tls = of_kind(objects, "Ingress", "bt-studio")["spec"]["tls"][0]["secretName"]
    assert of_kind(objects, "Secret", tls)["metadata"]["namespace"] == "bt-studio"
    assert of_kind(objects, "Secret", "bt-studio")["data"].keys() == written.keys()


def test_the_launcher_starts_robots_and_tools_of_the_imported_images(applied):
    imported = set(re.findall(r"bt-studio-\w+:1\b", block("docker save")))
    files = of_kind(applied, "ConfigMap", "bt-studio-pod")["data"]
    names = {Kind.SESSION: "executor-pod.yaml", Kind.TOOLS: "tools-pod.yaml"}
    templates = {kind: read_template(files[name]) for kind, name in names.items()}
    with FakeCluster() as cluster:
        launcher = KubernetesLauncher(client_of(cluster, NAMESPACE), templates)
        launcher.start(spec())
        launcher.open_tools("u1", "t0ken", timeout_s=60)
        pods = [cluster.object("pods", name) for name in cluster.names("pods")]
        cluster.die()  # a watch that waits for the next event is not interrupted otherwise
        launcher.close()
    assert pod_name(Kind.SESSION, "s1") in {pod["metadata"]["name"] for pod in pods}
    assert len(pods) == 2
    (web,) = pods_of(applied)["bt-studio-web"]["containers"]
    containers = [web, *(pod["spec"]["containers"][0] for pod in pods)]
    assert {container["image"] for container in containers} == imported
    # An image with its own tag is pulled only where it is missing.
    assert not any("imagePullPolicy" in container for container in containers)
