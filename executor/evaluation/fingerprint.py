"""The platform fingerprint: machines with the same one give the same outcomes."""

from __future__ import annotations

import hashlib
import json
import platform
import sys
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

PACKAGES: Final = ("bt-studio", "numpy", "pybullet", "py-trees", "opencv-python-headless")
LIBRARIES: Final = ("libgallium", "libLLVM", "libEGL_mesa", "swrast_dri")
_FOLDERS: Final = ("/usr/lib", "/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu")


def fingerprint() -> dict[str, str]:
    """Returns the parts of the fingerprint by name, and `id`, a digest of all of them."""
    found = {"processor": _digest(_processor_flags()), "machine": platform.machine()}
    found["python"] = platform.python_version()
    found["drawing"] = _digest(",".join(_libraries()))
    found["packages"] = _digest("\n".join(sorted(f"{d.name}=={d.version}" for d in _installed())))
    for name in PACKAGES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return {"id": _digest(json.dumps(found, sort_keys=True)), **found}


def differences(mine: dict[str, str], other: dict[str, str]) -> list[str]:
    """Returns the differences between two fingerprints, in words."""
    names = sorted((mine.keys() | other.keys()) - {"id"})
    return [
        f"{name}: {other.get(name, 'missing')} then, {mine.get(name, 'missing')} now"
        for name in names
        if mine.get(name) != other.get(name)
    ]


def _installed() -> Iterable[metadata.Distribution]:
    """Returns the installed packages, without those that Ray carries along when it is loaded."""
    return metadata.distributions(path=[path for path in sys.path if "thirdparty_files" not in path])


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _processor_flags() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return platform.processor()
    return next(
        (line.partition(":")[2].strip() for line in lines if line.startswith(("flags", "Features"))), ""
    )


def _libraries() -> list[str]:
    """Returns the names of the installed libraries that draw; a name holds the version."""
    found = {
        path.resolve().name
        for folder in _FOLDERS
        for name in LIBRARIES
        for path in Path(folder).glob(f"{name}*")
    }
    return sorted(found)
