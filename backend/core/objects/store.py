"""The one door to the bucket. Every object is written once, under a name of its own, and is never changed.

So nothing that names an object can meet other bytes, and whatever deletes an object never takes one that
somebody writes at the same time. `django-storages` makes the connection; its client is used directly, since
it alone may be shared by threads. Both are imported when the first object is asked for.
"""

from __future__ import annotations

import hashlib
import io
import uuid
from contextlib import closing
from functools import lru_cache
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple
from urllib.parse import urlsplit

from backend.config.environment import environment
from backend.core.file_answers import saved_as
from backend.core.objects.errors import damaged, explained, not_configured

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from datetime import datetime

PART_BYTES: Final = 1 << 20
ADDRESS_S: Final = 60
"""How long an address for a browser is valid, in s."""


class Listed(NamedTuple):
    """An object of the bucket."""

    key: str
    size: int
    written_at: datetime


class Access(NamedTuple):
    """The parts of a connection."""

    address: str
    key: str
    secret: str
    region: str
    public: str


class ObjectStore:
    """A folder of a bucket."""

    def __init__(self, access: Access) -> None:
        parts = urlsplit(access.address)
        self.bucket, _, folder = parts.path.lstrip("/").partition("/")
        self._folder = f"{folder}/" if folder else ""
        self.place = f"the bucket “{self.bucket}” at {parts.scheme}://{parts.netloc}"
        self._access = access
        self._client = _client(access, f"{parts.scheme}://{parts.netloc}", self.bucket)

    def put(self, key: str, file: IO[bytes], size: int, sha256: str) -> None:
        """Stores an object, and reads it again to verify its size and hash.

        Raises:
            StoreError: it is not stored, or not as it was given.
        """
        with explained(self.place):
            file.seek(0)
            self._client.put_object(
                Bucket=self.bucket,
                Key=self._folder + key,
                Body=file,
                ContentLength=size,
                ContentType="application/octet-stream",
            )
        digest, found = hashlib.sha256(), 0
        for part in self.read(key):
            digest.update(part)
            found += len(part)
        if (found, digest.hexdigest()) != (size, sha256):
            self.delete([key])
            raise damaged(key, self.place)

    def get(self, key: str, sha256: str) -> bytes:
        """Returns a whole object, verified.

        Raises:
            ObjectMissingError: it is not there.
            StoreError: it is not what was stored, or the store cannot be used.
        """
        data = b"".join(self.read(key))
        if hashlib.sha256(data).hexdigest() != sha256:
            raise damaged(key, self.place)
        return data

    def read(self, key: str, begin: int = 0, end: int | None = None) -> Iterator[bytes]:
        """Yields the bytes of an object from `begin` to before `end`, in parts."""
        if end is not None and end <= begin:
            return
        last = "" if end is None else str(end - 1)
        wanted = {"Range": f"bytes={begin}-{last}"} if begin or last else {}
        with explained(self.place, key):
            answer = self._client.get_object(Bucket=self.bucket, Key=self._folder + key, **wanted)
            with closing(answer["Body"]) as body:
                yield from body.iter_chunks(PART_BYTES)

    def size(self, key: str) -> int:
        """Returns the size of an object in bytes.

        Raises:
            ObjectMissingError: it is not there.
        """
        with explained(self.place, key):
            return int(self._client.head_object(Bucket=self.bucket, Key=self._folder + key)["ContentLength"])

    def delete(self, keys: Iterable[str]) -> None:
        """Deletes objects; one that is not there is no error."""
        with explained(self.place):
            for key in keys:  # not every server deletes several by one request
                self._client.delete_object(Bucket=self.bucket, Key=self._folder + key)

    def listed(self, folder: str) -> Iterator[Listed]:
        """Yields the objects of a folder of ours, such as `blobs/`."""
        pages = self._client.get_paginator("list_objects_v2")
        with explained(self.place):
            for page in pages.paginate(Bucket=self.bucket, Prefix=self._folder + folder):
                for row in page.get("Contents", ()):
                    key = row["Key"].removeprefix(self._folder)
                    yield Listed(key, int(row["Size"]), row["LastModified"])

    def address(self, key: str, filename: str) -> str:
        """Returns an address under which a browser can download this one object for a minute."""
        client = _client(self._access, self._access.public, self.bucket)
        asked = {
            "Bucket": self.bucket,
            "Key": self._folder + key,
            "ResponseContentDisposition": saved_as(filename)["Content-Disposition"],
            "ResponseContentType": "application/octet-stream",
        }
        return str(client.generate_presigned_url("get_object", Params=asked, ExpiresIn=ADDRESS_S))

    def require_bucket(self) -> None:
        """Raises a StoreError if the bucket cannot be used."""
        with explained(self.place):
            self._client.list_objects_v2(Bucket=self.bucket, Prefix=self._folder, MaxKeys=1)

    def admits(self, origin: str) -> bool:
        """Returns whether the rules of the bucket (CORS) let pages of this origin, and no others, read it."""
        from botocore.exceptions import ClientError  # noqa: PLC0415 - as below

        with explained(self.place):
            try:
                rules = self._client.get_bucket_cors(Bucket=self.bucket)["CORSRules"]
            except ClientError as error:
                if error.response.get("Error", {}).get("Code") == "NoSuchCORSConfiguration":
                    return False
                raise
        origins = {one for rule in rules if "GET" in rule["AllowedMethods"] for one in rule["AllowedOrigins"]}
        return origins == {origin}


def new_key(folder: str, name: str) -> str:
    """Returns a name for an object that no other object has or had: `blobs/<hash>/<random>`."""
    return f"{folder}{name}/{uuid.uuid4().hex}"


def as_file(data: bytes) -> IO[bytes]:
    """Returns bytes as the file that `put` takes."""
    return io.BytesIO(data)


def store() -> ObjectStore | None:
    """Returns the object store that the settings name, or None."""
    found = environment()
    if not found.object_store:
        return None
    return _made(
        Access(
            found.object_store,
            found.object_store_key.get_secret_value(),
            found.object_store_secret.get_secret_value(),
            found.object_store_region,
            found.object_store_public,
        )
    )


def the_store() -> ObjectStore:
    """Returns the object store.

    Raises:
        StoreError: no store is set.
    """
    found = store()
    if found is None:
        raise not_configured()
    return found


def written_store(size: int) -> ObjectStore | None:
    """Returns the store that takes a new content of this size; None if it goes to the database."""
    settings = environment()
    if not settings.object_store or not settings.object_store_writes:
        return None
    return store() if size > settings.object_store_from_bytes else None


@lru_cache(maxsize=4)
def _made(access: Access) -> ObjectStore:
    return ObjectStore(access)


@lru_cache(maxsize=4)
def _client(access: Access, endpoint: str, bucket: str) -> Any:
    from botocore.config import Config  # noqa: PLC0415 - slow to load, and most servers need none of it
    from storages.backends.s3 import S3Storage  # noqa: PLC0415 - as above

    config = Config(
        s3={"addressing_style": "path"},
        signature_version="s3v4",
        connect_timeout=5,
        read_timeout=30,
        retries={"mode": "standard", "max_attempts": 2},
        max_pool_connections=32,
        # Checksums in trailers are not known to every server, and `put` reads what it wrote.
        request_checksum_calculation="when_required",
        response_checksum_validation="when_required",
    )
    with explained(f"the bucket “{bucket}” at {endpoint}"):
        made = S3Storage(
            bucket_name=bucket,
            endpoint_url=endpoint,
            region_name=access.region,
            access_key=access.key or None,
            secret_key=access.secret or None,
            client_config=config,
        )
        return made.connection.meta.client
