"""The parts of the program are listed: bills of materials, licences, and images pinned by digest."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import yaml

from tests.tools.sbom import write

ROOT = Path(__file__).parents[2]


def locked():
    return dict(re.findall(r"^([a-z0-9._-]+)==(\S+)", (ROOT / "requirements.lock").read_text(), re.MULTILINE))


def test_the_bills_of_materials_name_everything_that_is_locked(tmp_path):
    python, npm = (json.loads(path.read_text()) for path in write(tmp_path))
    assert {document["bomFormat"] for document in (python, npm)} == {"CycloneDX"}
    assert {part["name"]: part["version"] for part in python["components"]} == locked()
    assert all(part["externalReferences"][0]["hashes"] for part in python["components"])
    wanted = json.loads((ROOT / "frontend" / "package.json").read_text())
    parts = {"/".join(filter(None, (part.get("group"), part["name"]))): part for part in npm["components"]}
    assert wanted["dependencies"].keys() <= parts.keys()
    assert not {"vite", "eslint", "vitest"} & parts.keys()
    assert parts["react"]["licenses"] == [{"license": {"id": "MIT"}}]


def test_the_notices_of_an_image_have_every_package_with_its_licence():
    done = subprocess.run(
        [sys.executable, ROOT / "docker" / "notices.py"], capture_output=True, text=True, check=True
    )
    heads = re.findall(r"^## (\S+) \S+ \((.+)\)$", done.stdout, re.MULTILINE)
    names = {re.sub(r"[-_.]+", "-", name).lower() for name, _ in heads}
    assert locked().keys() <= names
    said = dict(heads)
    assert said["Django"] == "BSD-3-Clause"
    assert "Redistribution and use in source and binary forms" in done.stdout
    for name in ("web", "executor", "keeper", "evaluation"):
        assert (
            "notices.py > /opt/bt-studio/THIRD-PARTY-NOTICES"
            in (ROOT / f"docker/{name}.Dockerfile").read_text()
        )


def test_the_front_end_is_built_with_the_licences_of_what_is_in_it():
    notices = (ROOT / "frontend" / "dist" / "third-party-notices.md").read_text()
    for name in ("react", "three", "@mantine/core", "@codemirror/view", "@fontsource-variable/inter"):
        assert f"\n## {name} - " in notices
    assert "SIL OPEN FONT LICENSE" in notices.upper()


def images():
    """Each image of a registry that is built from or run."""
    for path in (ROOT / "docker").glob("*.Dockerfile"):
        stages = set()
        for line in path.read_text().splitlines():
            if found := re.match(r"FROM (\S+)(?: AS (\S+))?", line):
                if found[1] not in stages and not found[1].startswith("bt-studio-"):
                    yield found[1]
                stages.add(found[2])
    services = yaml.safe_load((ROOT / "docker" / "compose.yaml").read_text())["services"]
    yield from (
        service["image"] for service in services.values() if not service["image"].startswith("bt-studio-")
    )


def test_the_image_of_evaluations_has_the_versions_of_the_others():
    text = (ROOT / "docker" / "evaluation.lock").read_text()
    added = dict(re.findall(r"^([a-z0-9._-]+)==(\S+)", text, re.MULTILINE))
    assert "aiohttp" in added, "without its dashboard Ray takes no jobs"
    ours = (ROOT / "requirements-dev.lock").read_text()
    others = dict(re.findall(r"^([a-z0-9._-]+)==(\S+)", ours, re.MULTILINE)) | locked()
    assert {name: others[name] for name in added.keys() & others.keys()} == {
        name: added[name] for name in added.keys() & others.keys()
    }
    job = (ROOT / "docker" / "kubernetes-evaluations" / "evaluation-rayjob.yaml").read_text()
    assert f"rayVersion: {added['ray']}\n" in job


def test_dependabot_looks_after_every_kind_of_dependency():
    asked = yaml.safe_load((ROOT / ".github" / "dependabot.yml").read_text())["updates"]
    kinds = {(row["package-ecosystem"], row["directory"]) for row in asked}
    assert kinds >= {("npm", "/frontend"), ("pip", "/"), ("docker", "/docker"), ("github-actions", "/")}
    assert tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    assert (ROOT / ".github" / "SECURITY.md").read_text().startswith("# ")


def test_there_are_images_to_look_after():
    assert {name.partition("@")[0].partition(":")[0] for name in images()} == {
        "caddy",
        "debian",
        "node",
        "postgres",
        "redis",
    }
