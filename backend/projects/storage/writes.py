"""All writes to projects. Each function is one transaction; views only parse requests and make answers."""

from __future__ import annotations

from datetime import datetime, timedelta
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING

from django.db import IntegrityError, transaction
from django.utils import timezone

from backend.accounts.audit import forget_old, note
from backend.config.environment import environment
from backend.core.locks import transaction_lock
from backend.core.problems import InvalidInputError, NotFoundError
from backend.projects.errors import (
    NameTakenError,
    QuotaExceededError,
    RevisionConflictError,
    matches,
)
from backend.projects.models import Blob, ChangeSet, CurrentFile, Draft, IdempotencyKey, Project
from backend.projects.signals import project_deleted, revision_made
from backend.projects.storage import blobs, cache, names, queries, rows
from backend.projects.storage.access import Need
from backend.projects.storage.at_once import BLOBS
from backend.projects.storage.bounds import require_bounded
from backend.projects.storage.changes import Conflict, Content, Existing, FileChange, Plan, Stored, plan
from backend.projects.storage.manifest import MANIFEST, Manifest, read, write
from backend.projects.storage.usage import room_for_archive

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.storage.changes import Source
    from backend.projects.storage.queries import ListedFile


def create_project(
    files: Mapping[str, bytes | Source | Stored],
    *,
    acting_user: User,
    name: str = "",
    message: str = "Create the project",
) -> Project:
    """Makes a project from these files.

    Args:
        files: the contents by path; `project.json`, which is not one of those stored already, is added if it
            is missing.
        acting_user: the owner of the new project.
        name: the name of the project; "" takes the name in `project.json`, with a number if that is taken.
        message: the message of the first change set.

    Raises:
        NameTakenError: another project of the user has the name `name`.
        InvalidInputError: a path or `project.json` is invalid.
        QuotaExceededError: the project is too large.
    """
    checked = {
        names.writable_path(path): Content.of(data) if isinstance(data, bytes) else data
        for path, data in files.items()
    }
    may_write = partial(_may_create, checked, acting_user)
    with blobs.placed(checked.values(), may_write) as stored:
        return _create(checked, stored, acting_user=acting_user, name=name, message=message)


def _may_create(files: Mapping[str, Source | Stored], user: User) -> None:
    """Refuses what `_create` will refuse, before anything is uploaded."""
    for path, content in files.items():
        if content.size > environment().max_file_bytes:
            raise too_large(path)
    if sum(content.size for content in files.values()) > room_for_archive(user):
        raise QuotaExceededError("The projects of one user together take more bytes than are allowed.")


@transaction.atomic
def _create(
    files: Mapping[str, Source | Stored],
    stored: Mapping[str, str],
    *,
    acting_user: User,
    name: str,
    message: str,
) -> Project:
    checked = dict(files)
    own = checked.get(MANIFEST)
    manifest = read(b"{}" if own is None or isinstance(own, Stored) else own.data)
    transaction_lock(f"projects of {acting_user.pk}")
    taken = set(Project.objects.filter(owner=acting_user, deleted_at=None).values_list("name_key", flat=True))
    allowed = acting_user.max_projects
    if len(taken) >= (environment().max_user_projects if allowed is None else allowed):
        raise QuotaExceededError(
            f"You have {len(taken)} projects, and more are not allowed.",
            hint="Delete some that you no longer need.",
        )
    final = names.project_name(name) if name else names.free_name(manifest.name, taken)
    if manifest.document.get("name") != final:
        document = {"format": "bt-studio/project", "version": 1} | dict(manifest.document) | {"name": final}
        checked[MANIFEST] = Content.of(write(document))
    now = timezone.now()
    transaction_lock(BLOBS, shared=True)
    project = Project(
        owner=acting_user, name=final, name_key=names.key(final), created_at=now, updated_at=now
    )
    _save_name(project, force_insert=True)
    wanted = [FileChange(path, 0, checked[path]) for path in sorted(checked)]
    _apply(project, wanted, acting_user=acting_user, message=message, now=now, stored=stored)
    note("project.create", actor=acting_user, subject=final, subject_id=project.id, message=message)
    return project


def save_files(
    project_id: UUID,
    wanted: Sequence[FileChange],
    *,
    acting_user: User,
    message: str = "",
    if_match: str = "",
) -> Project:
    """Applies a change set completely or not at all.

    Raises:
        RevisionConflictError: a base revision is stale; the error has both versions of each such file.
        PreconditionFailedError: `if_match` is not the ETag of the newest revision.
        InvalidInputError: the resulting project would be invalid.
        QuotaExceededError: the resulting project would be too large.
    """
    may_write = partial(_may_save, project_id, wanted, acting_user)
    with blobs.placed((change.content for change in wanted), may_write) as stored:
        return _save(project_id, wanted, stored, acting_user=acting_user, message=message, if_match=if_match)


def _may_save(project_id: UUID, wanted: Sequence[FileChange], user: User) -> None:
    """Refuses what `_save` will refuse, before anything is uploaded."""
    queries.project(project_id, user=user, need=Need.WRITE)
    for change in wanted:
        if change.content is not None and change.content.size > environment().max_file_bytes:
            raise too_large(change.path)


@transaction.atomic
def _save(  # noqa: PLR0913 - those of `save_files`, and the objects
    project_id: UUID,
    wanted: Sequence[FileChange],
    stored: Mapping[str, str],
    *,
    acting_user: User,
    message: str,
    if_match: str,
) -> Project:
    project = _locked(project_id, acting_user)
    require_match(project, if_match)
    checked = [_checked(change) for change in wanted]
    for change in checked:
        if change.base_revision > project.revision:
            raise InvalidInputError(
                f"The project has no revision {change.base_revision}; the newest is {project.revision}.",
                field="files.base_revision",
            )
    _apply(project, checked, acting_user=acting_user, message=message, now=timezone.now(), stored=stored)
    return project


@transaction.atomic
def edit_settings(  # noqa: PLR0913 - the fields that a request may change
    project_id: UUID,
    *,
    acting_user: User,
    base_revision: int,
    name: str | None = None,
    description: str | None = None,
    settings: Mapping[str, object] | None = None,
    if_match: str = "",
) -> Project:
    """Changes fields of `project.json` in a change set."""
    project = _locked(project_id, acting_user)
    require_match(project, if_match)
    raw = queries.current_files(project, [MANIFEST])[MANIFEST].data
    document = dict(read(raw).document) if settings is None else dict(settings)
    document |= {"name": names.project_name(name)} if name is not None else {}
    document |= {"description": description} if description is not None else {}
    change = FileChange(MANIFEST, base_revision, Content.of(write(document)))
    message = "Rename the project" if name is not None else "Change the settings"
    return save_files(project.id, [change], acting_user=acting_user, message=message)


@transaction.atomic
def restore_revision(
    project_id: UUID, number: int, *, acting_user: User, paths: Sequence[str] = (), if_match: str = ""
) -> Project:
    """Restores files of an old revision as a new revision: those of `paths`, or all if it is empty."""
    project = _locked(project_id, acting_user)
    require_match(project, if_match)
    then = queries.listed_at(project, number)
    now = queries.existing_files(project)
    chosen = set(paths) or (set(then) | set(now))
    if missing := chosen - set(then) - set(now):
        raise NotFoundError(f"Revision {number} has no file “{names.shown(min(missing))}”.")
    wanted = []
    for path in sorted(chosen):
        base = now[path].revision if path in now else 0
        if path not in then:
            wanted.append(FileChange(path, base, delete=True))
        elif not names.is_of_tool(path) and (path not in now or now[path].sha256 != then[path].sha256):
            old = then[path]
            content = Stored(old.sha256, old.size) if path != MANIFEST else _keeping_name(old, project)
            wanted.append(FileChange(path, base, content))
    _apply(project, wanted, acting_user=acting_user, message=f"Restore revision {number}", now=timezone.now())
    return project


def _keeping_name(old: ListedFile, project: Project) -> Content:
    """Returns an old `project.json` with the current name, since the old name may be taken now."""
    document = dict(read(queries.data_of([old])[MANIFEST]).document) | {"name": project.name}
    return Content.of(write(document))


@transaction.atomic
def label_revision(
    project_id: UUID, number: int, label: str, *, acting_user: User, if_match: str = ""
) -> ChangeSet:
    """Sets or removes the label of a revision; `if_match` is the ETag of the revision."""
    project = _locked(project_id, acting_user)
    change = queries.change_set(project, number)
    matches(if_match, queries.revision_etag(change), "The label of this revision has changed.")
    change.label = label.strip()
    change.save(update_fields=["label"])
    return change


@transaction.atomic
def duplicate_project(project_id: UUID, *, acting_user: User, name: str = "") -> Project:
    """Makes a new project from the current files, without their history."""
    source = queries.project(project_id, user=acting_user, need=Need.COPY)
    # In the order of `_create`. From now on no content of the project is collected.
    transaction_lock(f"projects of {acting_user.pk}")
    transaction_lock(BLOBS, shared=True)
    current = queries.existing_files(source)
    files: dict[str, bytes | Source | Stored] = {
        path: Stored(file.sha256, file.size) for path, file in current.items() if not names.is_of_tool(path)
    }
    files |= queries.data_of([current[MANIFEST]])
    return create_project(files, acting_user=acting_user, name=name, message=f"Duplicate of {source.name}")


@transaction.atomic
def delete_project(project_id: UUID, *, acting_user: User, if_match: str = "") -> None:
    """Marks a project as deleted; until its garbage is collected, `restore_project` can restore it."""
    project = _locked(project_id, acting_user, Need.MANAGE)
    require_match(project, if_match)
    project.deleted_at = timezone.now()
    project.save(update_fields=["deleted_at"])
    note("project.delete", actor=acting_user, subject=project.name, subject_id=project.id)
    # `send_robust`, since the deletion is committed: an error in a receiver must not make it look as if it
    # had failed.
    transaction.on_commit(lambda: project_deleted.send_robust(Project, project_id=project.id), robust=True)


@transaction.atomic
def restore_project(project_id: UUID, *, acting_user: User, if_match: str = "") -> Project:
    """Restores a deleted project, under another name if its own has been taken since."""
    project = queries.deleted_project(project_id, user=acting_user)
    require_match(project, if_match)
    if project.deleted_at is None:
        return project
    transaction_lock(f"projects of {acting_user.pk}")
    taken = set(
        Project.objects.filter(owner=project.owner, deleted_at=None).values_list("name_key", flat=True)
    )
    name = names.free_name(project.name, taken)
    project.deleted_at = None
    project.save(update_fields=["deleted_at"]) if name == project.name else _revive(
        project, name, acting_user
    )
    note("project.restore", actor=acting_user, subject=name, subject_id=project.id)
    return project


def _revive(project: Project, name: str, acting_user: User) -> None:
    project.name, project.name_key = name, names.key(name)
    project.save(update_fields=["deleted_at", "name", "name_key"])
    raw = queries.current_files(project, [MANIFEST])[MANIFEST]
    document = dict(read(raw.data).document) | {"name": name}
    change = FileChange(MANIFEST, raw.revision, Content.of(write(document)))
    transaction_lock(BLOBS, shared=True)
    _apply(
        project, [change], acting_user=acting_user, message="Restore under another name", now=timezone.now()
    )


@transaction.atomic
def set_archived(project_id: UUID, *, acting_user: User, archived: bool, if_match: str = "") -> Project:
    """Moves a project to the archive, or out of it."""
    project = _locked(project_id, acting_user, Need.MANAGE)
    require_match(project, if_match)
    project.archived_at = (project.archived_at or timezone.now()) if archived else None
    project.save(update_fields=["archived_at"])
    return project


@transaction.atomic
def collect_garbage(*, now: datetime | None = None) -> int:
    """Removes data that can no longer be reached; returns the number of removed blobs."""
    now = now or timezone.now()
    limits = environment()
    # A save may be about to use a blob to which no row refers yet.
    transaction_lock(BLOBS)
    Project.objects.filter(deleted_at__lt=now - timedelta(days=limits.deleted_project_days)).delete()
    forget_old(now)
    Draft.objects.filter(updated_at__lt=now - timedelta(days=limits.draft_days)).delete()
    IdempotencyKey.objects.filter(created_at__lt=now - timedelta(days=1)).delete()
    # Those in the object store go by `collection`.
    return Blob.objects.filter(filerevision=None, currentfile=None, stored_at=None).delete()[0]


def require_match(project: Project, if_match: str) -> None:
    """Raises a PreconditionFailedError if the `If-Match` header does not name the newest revision."""
    matches(if_match, queries.etag(project), f"The newest revision is {project.revision}.", project.revision)


def _locked(project_id: UUID, user: User, need: Need = Need.WRITE) -> Project:
    return queries.project(project_id, user=user, need=need, lock=True)


def _checked(change: FileChange) -> FileChange:
    # Files with names that only an older version allowed can still be deleted and renamed.
    rule = names.file_path if change.content is None or change.rename_to else names.writable_path
    return FileChange(
        path=rule(change.path, field="files.path"),
        base_revision=change.base_revision,
        content=change.content,
        delete=change.delete,
        rename_to=names.writable_path(change.rename_to, field="files.rename_to") if change.rename_to else "",
    )


def _apply(  # noqa: PLR0913 - a change set has them all
    project: Project,
    wanted: Sequence[FileChange],
    *,
    acting_user: User,
    message: str,
    now: datetime,
    stored: Mapping[str, str] = MappingProxyType({}),
) -> None:
    """Applies changes to a project. The caller holds the locks of the project and of the blobs.

    `stored` are the objects that were uploaded for these changes, by the hashes of their contents.
    """
    current = queries.existing_files(project)
    result = plan(current, wanted)
    if result.conflicts:
        raise conflict_error(project, result.conflicts)
    paths = [change.path for change in wanted]
    if result.is_empty:
        rows.forget_drafts(project, acting_user.pk, paths)
        project.now = current
        return
    manifest = _manifest_after(result)
    project.size = _size_after(project, current, result)
    require_bounded(current, result)
    project.revision, project.updated_at = project.revision + 1, now
    change = ChangeSet(
        project=project, number=project.revision, author=acting_user, message=message[:500], created_at=now
    )
    contents = {w.sha256: w.content for w in result.written if w.content is not None}
    for content in contents.values():
        if isinstance(content, Content):  # in memory already
            (cache.put_stored if content.sha256 in stored else cache.put)(content.sha256, content.data)
    if result.removed:
        CurrentFile.objects.filter(project=project, path__in=result.removed).delete()
    removed = [(path, None, "") for path in result.removed]
    rows.write(
        rows.Writing(
            change=change,
            blobs=[content for sha256, content in contents.items() if sha256 not in stored],
            stored=[(sha256, c.size, stored[sha256]) for sha256, c in contents.items() if sha256 in stored],
            revisions=removed + [(w.path, w.sha256, w.renamed_from) for w in result.written],
            files=[(w.path, names.key(w.path), w.sha256) for w in result.written],
            drafts=paths,
        )
    )
    if manifest is not None:
        _store_manifest(project, manifest)
    left = {path: existing for path, existing in current.items() if path not in result.removed}
    project.now = left | {
        w.path: Existing(w.path, project.revision, w.sha256, w.size) for w in result.written
    }
    cache.put_files(project, project.now)
    revision_made.send(Project, change=change)


def _store_manifest(project: Project, manifest: Manifest) -> None:
    project.name, project.name_key = manifest.name, names.key(manifest.name)
    project.description = manifest.description
    project.main_tree, project.universe = manifest.main_tree, manifest.universe
    _save_name(project, update_fields=["name", "name_key", "description", "main_tree", "universe"])


def _manifest_after(result: Plan) -> Manifest | None:
    if MANIFEST in result.removed:
        raise InvalidInputError("A project must have a project.json.", field="files")
    for written in result.written:
        if written.path == MANIFEST:
            if written.content is None:
                raise InvalidInputError("No file can be renamed to project.json.", field="files")
            return read(written.content.data)
    return None


def _size_after(project: Project, current: Mapping[str, Existing], result: Plan) -> int:
    limits = environment()
    sizes = {path: existing.size for path, existing in current.items() if path not in result.removed}
    for written in result.written:
        if written.size > limits.max_file_bytes:
            raise too_large(written.path)
        sizes[written.path] = written.size
    if len(sizes) > limits.max_project_files:
        raise QuotaExceededError(f"A project has at most {limits.max_project_files} files.", field="files")
    total = sum(sizes.values())
    if total > limits.max_project_bytes and total > project.size:
        raise QuotaExceededError(
            f"The files of a project take at most {limits.max_project_bytes:,} bytes.", field="files"
        )
    if total > project.size:
        used = rows.taken_by_others(project)
        allowed = project.owner.max_bytes
        room = limits.max_user_bytes if allowed is None else allowed
        if used + total > room:
            raise QuotaExceededError(
                f"The projects of one user together take at most {room:,} bytes.",
                hint="Delete projects that you no longer need.",
            )
    return total


def too_large(path: str) -> QuotaExceededError:
    """Returns the error for a file that is larger than `BT_STUDIO_MAX_FILE_BYTES`."""
    return QuotaExceededError(
        f"“{names.shown(path)}” is larger than the {environment().max_file_bytes:,} bytes of a file.",
        field="files",
    )


def conflict_error(project: Project, conflicts: Sequence[Conflict]) -> RevisionConflictError:
    """Returns the error that contains both versions of each file in conflict."""
    theirs = queries.current_files(project, [c.theirs.path for c in conflicts if c.theirs])
    rows = []
    for conflict in conflicts:
        file = theirs.get(conflict.theirs.path) if conflict.theirs else None
        mine = conflict.change.content
        rows.append(
            {
                "path": conflict.path,
                "base_revision": conflict.change.base_revision,
                "theirs": file
                and {
                    "revision": file.revision,
                    "content": file.text,
                    "updated_at": file.updated_at.isoformat(),
                },
                "mine": {
                    "content": None
                    if mine is None or isinstance(mine, Stored)
                    else queries.as_text(mine.data)
                },
            }
        )
    listed = ", ".join(f"“{names.shown(c.path)}”" for c in conflicts[:3])
    return RevisionConflictError(
        f"{listed} changed since the revision that this save is based on.",
        hint="Compare both versions, and save again on top of the newest.",
        revision=project.revision,
        conflicts=rows,
    )


def _save_name(
    project: Project, *, force_insert: bool = False, update_fields: Sequence[str] | None = None
) -> None:
    """Saves a project. The database checks the name, so that two requests cannot take the same name."""
    try:
        with transaction.atomic():
            project.save(force_insert=force_insert, update_fields=update_fields)
    except IntegrityError as error:
        raise NameTakenError(
            f"You already have a project named “{names.shown(project.name)}”.",
            hint="Choose another name.",
            field="name",
        ) from error
