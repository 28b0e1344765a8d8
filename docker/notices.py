"""Prints the licences of all Python packages that an environment holds, for an image: `python notices.py`."""

from __future__ import annotations

import sys
from importlib import metadata
from pathlib import PurePosixPath

NAMES = ("licen", "copying", "notice", "authors")


def texts(found: metadata.Distribution) -> list[tuple[str, str]]:
    """Returns the name and the text of each licence file of a package."""
    chosen = {}
    for path in found.files or ():
        own = PurePosixPath(path)
        is_about = own.name.lower().startswith(NAMES) and own.suffix not in {".py", ".pyc"}
        is_listed = "licenses" in own.parts and any(part.endswith(".dist-info") for part in own.parts)
        if is_listed or (is_about and any(part.endswith(".dist-info") for part in own.parts)):
            chosen[str(own)] = path.read_binary().decode(errors="replace").strip()
    return sorted(chosen.items())


def licence(found: metadata.Distribution) -> str:
    """Returns the licence of a package in a word or two."""
    about = found.metadata
    short = about.get("License-Expression") or about.get("License") or ""
    named = [
        row.rpartition(" :: ")[2] for row in about.get_all("Classifier", []) if row.startswith("License ::")
    ]
    first = short.strip().splitlines()[:1]
    return first[0][:100] if first and len(short) < 200 else ", ".join(named) or "not said"


def main() -> None:
    """Writes the licences to the standard output."""
    every = {found.metadata["Name"].lower(): found for found in metadata.distributions()}
    write = sys.stdout.write
    write("# Third-party notices\n\nThe Python packages of this image, each with its licence.\n")
    write("Those of Debian's packages are in /usr/share/doc/*/copyright.\n")
    for _, found in sorted(every.items()):
        write(f"\n## {found.metadata['Name']} {found.version} ({licence(found)})\n")
        for name, text in texts(found):
            write(f"\n### {name}\n\n{text}\n")


if __name__ == "__main__":
    main()
