"""The download of all data of one user.

It is a zip with `account.json`, each of the user's projects as the zip of an export, and files of other apps.
The zip is made in a file, one project after the other and part by part, so that it is never completely in
memory and occupies no thread for long.
"""

from __future__ import annotations

import json
import shutil
import tempfile
import zipfile
from collections import deque
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from typing import IO, TYPE_CHECKING, Any, cast

from backend.accounts.groups import groups_of
from backend.accounts.models import AuditEntry
from backend.core.file_answers import FileAnswer
from backend.core.scratch import scratch
from backend.projects.documents.export import Zipping, items_of, write_zip
from backend.projects.models import ChangeSet, Draft, Project
from backend.projects.signals import data_asked
from backend.workers.aside import packing
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import Callable
    from uuid import UUID

    from django.http.response import HttpResponseBase
    from rest_framework.request import Request
    from rest_framework.views import APIView

    from backend.accounts.models import User
    from backend.projects.signals import MoreData


def write_archive(user: User, file: IO[bytes]) -> None:
    """Writes the zip to the file; waits until each project is packed."""
    made = _Packing(user, file)
    while (project := made.next()) is not None:
        with tempfile.TemporaryFile() as zipped:
            write_zip(items_of(project), zipped)
            made.add(project, zipped)
    while made.add_file():
        pass
    made.end()


def answer_with_archive(
    view: APIView, request: Request, user: User, headers: dict[str, str]
) -> HttpResponseBase:
    """Answers with the zip; separate threads pack the projects.

    Raises:
        AlreadyThereError: a zip is already being made for this user.
        NoRoomError, BusyError: too many large files are being sent, or too many jobs wait.
    """
    file = scratch().file(key=f"data of {user.pk}")
    try:
        answering = _Answering(view, request, user, file, headers)
    except BaseException:
        file.close()
        raise
    return answering.following()


class _Answering:
    """Packs one project after the other in the pool."""

    def __init__(
        self, view: APIView, request: Request, user: User, file: IO[bytes], headers: dict[str, str]
    ) -> None:
        self._view, self._request, self._user_id = view, request, user.pk
        self._packing = _Packing(user, file)
        self._file, self._headers = file, headers
        self._zipping: Zipping | None = None

    def following(self) -> HttpResponseBase:
        try:
            return self._following()
        except BaseException:
            self._give_up()
            raise

    def _following(self) -> HttpResponseBase:
        project = self._packing.next()
        if project is None:
            return self._with_files()
        self._zipping = Zipping(items_of(project), scratch().file(expected=project.size))
        return self._next_part(project, self._zipping)

    def _next_part(self, project: Project, zipping: Zipping) -> HttpResponseBase:
        work = zipping.next()
        if work is not None:
            return self._after(work, lambda: self._next_part(project, zipping))
        return self._after(partial(self._packing.add, project, zipping.file), self._added)

    def _added(self) -> HttpResponseBase:
        if self._zipping is not None:
            self._zipping.file.close()
        return self._following()

    def _after(self, work: Callable[[], None], following: Callable[[], HttpResponseBase]) -> Deferred:
        """Answers with what follows a piece of work, which a separate thread does."""

        def done(future: Future[None]) -> HttpResponseBase:
            try:
                future.result()
                return following()
            except BaseException:
                self._give_up()
                raise

        return Deferred(self._view, self._request, packing.ask(f"user {self._user_id}", work), done)

    def _give_up(self) -> None:
        if self._zipping is not None:
            self._zipping.give_up()
        self._packing.give_up()

    def _with_files(self) -> HttpResponseBase:
        """Adds a file, then lets other requests have the thread; answers after the last one."""
        try:
            if self._packing.add_file():
                turn: Future[None] = Future()
                turn.set_result(None)
                return Deferred(self._view, self._request, turn, lambda _: self._with_files())
            self._packing.end()
        except BaseException:
            self._packing.give_up()
            raise
        return FileAnswer(self._file, headers=self._headers)


class _Packing:
    """The zip that is being made."""

    def __init__(self, user: User, file: IO[bytes]) -> None:
        self._zip, self._file = zipfile.ZipFile(file, "w"), file
        more = [cast("MoreData", found) for _, found in data_asked.send(_Packing, user=user)]
        document = _account(user)
        for each in more:
            document |= each.document
        self._files = deque(file for each in more for file in each.files)
        account = json.dumps(document, ensure_ascii=False, indent=2) + "\n"
        self._zip.writestr("account.json", account, zipfile.ZIP_DEFLATED)
        rows = Project.objects.filter(owner=user).order_by("name_key", "id")
        self._left: deque[UUID] = deque(rows.values_list("id", flat=True))

    def next(self) -> Project | None:
        """Returns the next project, or None at the end; skips projects that were removed meanwhile."""
        while self._left:
            project = Project.objects.filter(id=self._left.popleft()).first()
            if project is not None:
                return project
        return None

    def add(self, project: Project, packed: IO[bytes]) -> None:
        """Adds a packed project without compressing it again."""
        place = "deleted" if project.deleted_at else "projects"
        packed.seek(0)
        with self._zip.open(f"{place}/{project.name} ({project.id}).zip", "w", force_zip64=True) as member:
            shutil.copyfileobj(packed, member)

    def add_file(self) -> bool:
        """Adds the next file of another app; returns False if there is none."""
        if not self._files:
            return False
        path, chunks = self._files.popleft()
        with self._zip.open(path, "w", force_zip64=True) as member:
            for chunk in chunks():
                member.write(chunk)
        return True

    def end(self) -> None:
        """Writes the rest of the zip."""
        self._zip.close()

    def give_up(self) -> None:
        """Removes the unfinished file."""
        with suppress(Exception):  # the disk may be full
            self._zip.close()
        self._file.close()


def _account(user: User) -> dict[str, Any]:
    log = AuditEntry.objects.filter(actor=user).values("at", "action", "subject", "address")
    drafts = Draft.objects.filter(author=user).values("project__name", "path", "content", "updated_at")
    changes = ChangeSet.objects.filter(author=user).exclude(project__owner=user)
    document: dict[str, Any] = {
        "username": user.username,
        "name": user.get_full_name(),
        "email": user.email,
        "joined": user.date_joined,
        "last_sign_in": user.last_login,
        "groups": [group.name for group in groups_of(user)],
        "log": list(log),
        "drafts": list(drafts),
        "changes_in_projects_of_others": list(
            changes.values("project__name", "number", "message", "created_at")
        ),
    }
    plain: dict[str, Any] = json.loads(json.dumps(document, default=str))
    return plain
