"""Makes the Python processes of this environment note what they read and run, while a run is measured."""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools.selection.table import ROOT
from tests.tools.selection.units import keepers

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

MODULE: Final = "_bt_studio_loaded"
NOTES_FUNCTIONS: Final = "BT_STUDIO_NOTE_FUNCTIONS"
"""`0` leaves the noting of functions out."""
_EXTENSION: Final = "_bt_studio_executed"


@contextmanager
def noting(folder: Path, sources: Iterable[str]) -> Iterator[None]:
    """Writes what processes read and run below `folder`, and takes itself away at the end."""
    logs = folder / "loaded"
    for each in (logs, folder / "executed"):
        each.mkdir(parents=True, exist_ok=True)
        each.chmod(0o1777)  # users' code may run as another user
    packages = Path(sysconfig.get_path("purelib"))
    module, line = packages / f"{MODULE}.py", packages / f"{MODULE}.pth"
    extension = packages / f"{_EXTENSION}.so"
    if os.environ.get(NOTES_FUNCTIONS, "1") != "0":
        (folder / "keepers").write_bytes(keepers(ROOT, sources))
        if problem := build(extension):
            print(f"tests: which functions run is not noted: {problem}; imports stand for them")
    shutil.copy(Path(__file__).with_name("loaded.py"), module)
    line.write_text(f"import {MODULE}; {MODULE}.begin({str(logs)!r}, {str(ROOT)!r})\n", encoding="utf-8")
    try:
        yield
    finally:
        for each in (line, module, extension):
            each.unlink(missing_ok=True)


def build(extension: Path) -> str:
    """Compiles what notes the functions; returns why that is not possible, or nothing."""
    source = Path(__file__).with_name("executed.c")
    compiler = (sysconfig.get_config_var("CC") or "cc").split()
    include = f"-I{sysconfig.get_path('include')}"
    command = [*compiler, "-O2", "-shared", "-fPIC", include, str(source), "-o", str(extension)]
    try:
        subprocess.run(command, check=True, capture_output=True, text=True, timeout=120)
    except (OSError, subprocess.SubprocessError) as error:
        extension.unlink(missing_ok=True)
        return str(error)
    return ""
