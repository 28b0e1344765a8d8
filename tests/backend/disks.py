"""A small disk, for tests of a server whose disk becomes full."""

from __future__ import annotations

import os
import resource
import subprocess
import tempfile
from contextlib import contextmanager
from functools import cache
from pathlib import Path

MEBIBYTE = 1024 * 1024


class SmallDisk:
    """A folder with little space: a tmpfs if this user may mount one, otherwise a limit on file sizes."""

    def __init__(self, folder, mebibytes, *, mounted):
        self.folder = folder
        self.mounted = mounted
        # The command before a program that makes the limit apply to it.
        self.prefix = () if mounted else ("prlimit", f"--fsize={mebibytes * MEBIBYTE // 4}")

    @contextmanager
    def limited(self):
        """Makes the limit apply to this process, too."""
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        if not self.mounted:
            resource.setrlimit(resource.RLIMIT_FSIZE, (MEBIBYTE // 4, before[1]))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)

    def limited_at(self, function):
        """Returns a function for which alone the limit applies: what comes before it has room in `/tmp`."""

        def limited(*arguments):
            with self.limited():
                return function(*arguments)

        return limited

    def grow(self, mebibytes):
        if self.mounted:
            subprocess.run(["mount", "-o", f"remount,size={mebibytes}m", self.folder], check=True)
        self.prefix = ()


@cache
def may_mount():
    """Whether this user may mount a disk here; root in a container often may not."""
    if os.geteuid() != 0:
        return False
    with tempfile.TemporaryDirectory() as name, small_disk(Path(name) / "disk", 1) as disk:
        return disk.mounted


@contextmanager
def small_disk(folder, mebibytes):
    """Makes the folder, and removes it with its content afterwards."""
    folder.mkdir()
    options = ["-t", "tmpfs", "-o", f"size={mebibytes}m", "bts-test"]
    mounted = (
        os.geteuid() == 0
        and subprocess.run(["mount", *options, folder], check=False, capture_output=True).returncode == 0
    )
    try:
        yield SmallDisk(folder, mebibytes, mounted=mounted)
    finally:
        if mounted:
            subprocess.run(["umount", "--lazy", folder], check=True)
