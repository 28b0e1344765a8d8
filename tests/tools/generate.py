"""`make generate`: writes every generated source and reference page again.

A test beside each part compares the committed files with the output of its generator.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parent.parent.parent
GENERATORS: Final = (
    [sys.executable, "-m", "tests.tools.version"],
    [sys.executable, "-m", "tests.tree_gardener.reference_page"],
    [sys.executable, "-m", "tests.tools.interfaces"],
    [sys.executable, "-m", "translator.reference"],
    [sys.executable, "-m", "executor.generate.protocol_page"],
    [sys.executable, "-m", "executor.universes.reference"],
    [sys.executable, "-m", "executor.robots.reference"],
    [sys.executable, "-m", "executor.evaluation.reference.schema"],
    [sys.executable, "-m", "executor.evaluation.reference.page"],
    [sys.executable, "-m", "executor.generate.topics_table"],
    [sys.executable, "-m", "executor.generate.textures"],
    [sys.executable, "-m", "executor.generate.typescript"],
    [sys.executable, "-m", "backend.config.reference"],
    ["npm", "run", "--silent", "--prefix", "frontend", "generate"],
    [sys.executable, "-m", "tests.contracts.public_names"],
    # The pages that Django renders have the colours of the IDE; they are served without its build.
    ["cp", "frontend/src/ui/tokens.css", "backend/accounts/static/accounts/tokens.css"],
    # A distribution holds its licence, and can take no file from outside of its folder.
    ["cp", "LICENSE", "tree_gardener/LICENSE"],
)


def main() -> None:
    """Runs the generators, each from the root of the repository."""
    for command in GENERATORS:
        subprocess.run(command, cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
