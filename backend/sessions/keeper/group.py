"""Checks whether the keeper may use Docker's socket.

The keeper is not root, but a member of the socket's group.
"""

from __future__ import annotations

import os
import stat
from typing import Final

from backend.sessions.keeper.errors import KeeperError

GROUP_MAY: Final = stat.S_IRGRP | stat.S_IWGRP


def check_socket(path: str) -> None:
    """Checks that the socket can be used.

    Raises:
        KeeperError: the socket cannot be used; the text says what to set.
    """
    try:
        found = os.stat(path)  # noqa: PTH116 - a path that Docker gives as text
    except OSError as error:
        raise _refusal("docker_missing", f"There is no {path}: {error.strerror}.") from error
    if not stat.S_ISSOCK(found.st_mode):
        raise _refusal("docker_missing", f"{path} is no socket. Set BT_STUDIO_DOCKER_SOCKET to Docker's.")
    if os.access(path, os.R_OK | os.W_OK):
        return
    if found.st_mode & GROUP_MAY != GROUP_MAY:
        mode = f"{stat.S_IMODE(found.st_mode):04o}"
        raise _refusal("keeper_group", f"The mode {mode} of {path} excludes its group {found.st_gid}.")
    groups = ", ".join(str(group) for group in sorted({os.getgid(), *os.getgroups()}))
    raise _refusal(
        "keeper_group",
        f"Docker's socket {path} belongs to group {found.st_gid}, and the keeper is in {groups}. "
        f"Set BT_STUDIO_DOCKER_GID={found.st_gid} in docker/.env and start again.",
    )


def _refusal(code: str, detail: str) -> KeeperError:
    return KeeperError(503, code, f"{code}: {detail}")
