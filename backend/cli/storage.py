"""`bt-studio admin storage`: the object store of a server, what is in it, and the way there and back."""

from __future__ import annotations

import hashlib
import sys
from typing import TYPE_CHECKING, NamedTuple

import typer

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
from backend.cli.shared.progress import show_progress
from backend.cli.shared.stored import stored_projects

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from django.db.models import Model, QuerySet

    from backend.core.objects.store import ObjectStore

storage = typer.Typer(
    name="storage",
    help="The object store of BT_STUDIO_OBJECT_STORE, for large files and recordings.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
_TRIAL = b"bt-studio admin storage check"


class Kind(NamedTuple):
    """Files or recordings: their name, their folder, and the functions that move them."""

    name: str
    folder: str
    movable: Callable[[], QuerySet[Model]]
    moved: Callable[[], QuerySet[Model]]
    move_out: Callable[[ObjectStore], Iterator[int]]
    move_back: Callable[[ObjectStore], Iterator[int]]
    named: Callable[[list[str]], set[str]]


@storage.command()
def check() -> None:
    """Tries the bucket, and compares it with the database. The status is 1 if an object is missing."""
    with stored_projects():
        bucket = _bucket()
        _try(bucket)
        print(f"{bucket.place}: writing, reading, listing and deleting work.")
        _check_rules(bucket)
        missing = [key for kind in _kinds() for key in _compare(bucket, kind)]
        if missing:
            raise CliError(
                *(f"missing or of another size: {key}" for key in missing[:100]),
                f"{len(missing)} objects are missing or of another size in {bucket.place}: bring them back "
                "from a backup of the bucket.",
            )


@storage.command()
def migrate() -> None:
    """Moves large files and recordings from the database to the bucket, while the server runs.

    If it is interrupted, start it again: it continues.
    """
    with stored_projects():
        from backend.config.environment import environment

        bucket = _bucket()
        if not environment().object_store_writes:
            raise CliError(
                "BT_STUDIO_OBJECT_STORE_WRITES is false, so nothing belongs in the bucket: set it to true.",
                status=BAD_ARGUMENTS,
            )
        _try(bucket)
        for kind in _kinds():
            total = kind.movable().count()
            print(
                f"{kind.name}: {_followed(kind.name, total, kind.move_out(bucket))} moved to {bucket.place}."
            )


@storage.command()
def undo() -> None:
    """Moves everything from the bucket back to the database, while the server runs.

    All web servers must have BT_STUDIO_OBJECT_STORE_WRITES=false before, so that nothing new comes.
    """
    with stored_projects():
        from backend.config.environment import environment

        bucket = _bucket()
        if environment().object_store_writes:
            raise CliError(
                "The web servers would store new files in the bucket meanwhile: set "
                "BT_STUDIO_OBJECT_STORE_WRITES=false for all of them and for this command, and restart them.",
                status=BAD_ARGUMENTS,
            )
        for kind in _kinds():
            total = kind.moved().count()
            print(
                f"{kind.name}: {_followed(kind.name, total, kind.move_back(bucket))} moved to the database."
            )
        print("BT_STUDIO_OBJECT_STORE can be removed now.")


@storage.command()
def collect() -> None:
    """Deletes what nothing has needed for a day, as the server does once a day by itself."""
    with stored_projects():
        from backend.config.objects import collect_objects

        found = collect_objects(_bucket(), told=lambda n: show_progress(f"{n} objects looked at"))
        show_progress("")
        print(f"{found.marked} files marked, {found.deleted} deleted; {found.swept} objects without a row.")


def _bucket() -> ObjectStore:
    from backend.core.objects.store import store

    found = store()
    if found is None:
        raise CliError(
            "No object store is set: BT_STUDIO_OBJECT_STORE=https://host/bucket, with its key and secret.",
            status=BAD_ARGUMENTS,
        )
    return found


def _kinds() -> Iterable[Kind]:
    from backend.projects.storage import blobs, collection, moving
    from backend.runs import moving as runs_moving
    from backend.runs import objects as runs

    return (
        Kind(
            *("files", blobs.FOLDER, moving.movable, moving.moved),
            *(moving.move_out, moving.move_back, collection.named),
        ),
        Kind(
            *("recordings", runs.FOLDER, runs_moving.movable, runs_moving.moved),
            *(runs_moving.move_out, runs_moving.move_back, runs.named),
        ),
    )


def _try(bucket: ObjectStore) -> None:
    """Writes, reads and deletes an object; raises a StoreError that says what does not work."""
    from backend.core.objects.store import as_file, new_key

    bucket.require_bucket()
    sha256 = hashlib.sha256(_TRIAL).hexdigest()
    key = new_key("check/", "trial")
    bucket.put(key, as_file(_TRIAL), len(_TRIAL), sha256)
    bucket.delete([key])


def _check_rules(bucket: ObjectStore) -> None:
    from backend.config.environment import environment

    settings = environment()
    if not settings.object_store_public:
        print("Downloads go through the web server (BT_STUDIO_OBJECT_STORE_PUBLIC is empty).")
        return
    origin = settings.public_url or f"http://{settings.host}:{settings.port}"
    if not bucket.admits(origin):
        raise CliError(
            f"Browsers may not download from {bucket.place}: its CORS rules must allow GET from {origin}, "
            "and from no other origin. Set this rule on the bucket:",
            f'{{"CORSRules": [{{"AllowedMethods": ["GET"], "AllowedOrigins": ["{origin}"]}}]}}',
        )
    print(f"Browsers download from {settings.object_store_public}: its CORS rules allow {origin} alone.")


def _compare(bucket: ObjectStore, kind: Kind) -> list[str]:
    """Prints what is where; returns the objects that rows name and that are not as they should be."""
    there = {}
    for found in bucket.listed(kind.folder):
        there[found.key] = found.size
        if len(there) % 1000 == 0:
            show_progress(f"{kind.name}: {len(there)} objects")
    show_progress("")
    rows = dict(kind.moved().values_list("stored_at", "size"))
    print(
        f"{kind.name}: {len(rows)} in the bucket ({sum(rows.values()):,} bytes), "
        f"{kind.movable().count()} in the database that `migrate` would move, "
        f"{len(there.keys() - rows.keys())} objects without a row."
    )
    wrong = [key for key, size in rows.items() if there.get(key) != size]
    # One may have come or gone while the bucket was listed.
    return sorted(key for key in kind.named(wrong) if _is_wrong(bucket, key, rows[key]))


def _is_wrong(bucket: ObjectStore, key: str, size: int) -> bool:
    from backend.core.objects.errors import ObjectMissingError

    try:
        return bucket.size(key) != size
    except ObjectMissingError:
        return True


def _followed(name: str, total: int, sizes: Iterator[int]) -> str:
    """Moves, and shows how far it is; returns the number and bytes as text."""
    number = size = 0
    try:
        for one in sizes:
            number, size = number + 1, size + one
            show_progress(f"{name}: {number} of {total}, {size:,} bytes")
    except BaseException:
        show_progress("")
        print(f"{name}: {number} of {total} were moved; the same command continues.", file=sys.stderr)
        raise
    show_progress("")
    return f"{number} ({size:,} bytes)"
