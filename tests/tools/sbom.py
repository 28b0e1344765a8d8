"""`make sbom`: writes the bill of materials as CycloneDX, from the locks: Python and npm.

What Debian adds to an image is not in them; a scanner of images lists that.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, Final

REPOSITORY = Path(__file__).parents[2]
DEVELOPMENT: Final = {"name": "cdx:npm:package:development", "value": "true"}
CYCLONEDX = Path(sys.executable).with_name("cyclonedx-py")


def write(folder: Path) -> list[Path]:
    """Writes both files."""
    folder.mkdir(parents=True, exist_ok=True)
    python, npm = folder / "python.cdx.json", folder / "frontend.cdx.json"
    locks = ("requirements", "requirements.lock", "--pyproject", "pyproject.toml")
    how = ("--of", "JSON", "--output-reproducible", "--no-validate", "-o", str(python))
    subprocess.run((str(CYCLONEDX), *locks, *how), cwd=REPOSITORY, check=True, capture_output=True)
    asked = ("npm", "sbom", "--package-lock-only", "--sbom-format", "cyclonedx")
    done = subprocess.run(asked, cwd=REPOSITORY / "frontend", check=True, capture_output=True)
    npm.write_text(json.dumps(_used(json.loads(done.stdout)), indent=2) + "\n", encoding="utf-8")
    return [python, npm]


def _used(document: dict[str, Any]) -> dict[str, Any]:
    """Removes packages for builds and tests only; npm's own `--omit dev` also drops shared ones."""
    parts = [part for part in document["components"] if DEVELOPMENT not in part.get("properties", [])]
    kept = {part["bom-ref"] for part in parts} | {document["metadata"]["component"]["bom-ref"]}
    edges = [
        edge | {"dependsOn": [each for each in edge.get("dependsOn", []) if each in kept]}
        for edge in document["dependencies"]
        if edge["ref"] in kept
    ]
    return document | {"components": parts, "dependencies": edges}


def main() -> int:
    """The command line; returns the exit status."""
    for path in write(Path(sys.argv[1])):
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
