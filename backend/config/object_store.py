"""Settings of the object store: a bucket of an S3-compatible server for large contents."""

from __future__ import annotations

import re
from typing import Final, Self
from urllib.parse import urlsplit

from pydantic import Field, SecretStr, field_validator, model_validator
from pydantic_settings import BaseSettings

MEBIBYTE: Final = 1024 * 1024
_HOST: Final = re.compile(r"[A-Za-z0-9.-]+(:\d{1,5})?|\[[0-9A-Fa-f:]+\](:\d{1,5})?")
_BUCKET: Final = re.compile(r"[a-z0-9][a-z0-9.-]{1,61}[a-z0-9]")
_FOLDER: Final = re.compile(r"[A-Za-z0-9._-]+(/[A-Za-z0-9._-]+)*|")


class ObjectStoreSettings(BaseSettings):
    """Where large contents are stored; by default in the database."""

    object_store: str = Field(
        default="",
        description="A bucket of an S3-compatible server, for contents larger than "
        "`BT_STUDIO_OBJECT_STORE_FROM_BYTES`: `https://host/bucket` or `https://host/bucket/folder`. Each "
        "server with a database of its own needs a folder of its own. Empty: they are in the database.",
    )
    object_store_key: SecretStr = Field(
        default=SecretStr(""),
        description="Access key of the bucket. Without one, boto3 looks for credentials as in every program "
        "of it, for example a role of the machine or of the pod.",
    )
    object_store_secret: SecretStr = Field(default=SecretStr(""), description="The secret of that key.")
    object_store_region: str = Field(
        default="us-east-1", description="Region of the bucket; most servers but Amazon's ignore it."
    )
    object_store_from_bytes: int = Field(
        default=MEBIBYTE,
        ge=0,
        description="Files of projects and recordings larger than this are stored in the bucket.",
    )
    object_store_writes: bool = Field(
        default=True,
        description="Whether new contents are stored in the bucket; `false`: it is only read, so that "
        "`bt-studio admin storage undo` can empty it.",
    )
    object_store_public: str = Field(
        default="",
        description="Origin under which browsers reach the bucket, `https://files.example.org`: downloads of "
        "what is in it are redirected to an address that is valid for 60 s. Empty: the web server sends all.",
    )

    @field_validator("object_store")
    @classmethod
    def _bucket_address(cls, value: str) -> str:
        value = value.rstrip("/")
        if not value:
            return value
        parts = urlsplit(value)
        bucket, _, folder = parts.path.lstrip("/").partition("/")
        if parts.scheme not in {"http", "https"} or not _HOST.fullmatch(parts.netloc):
            raise ValueError("this must be https://host[:port]/bucket, without a name or password")
        if not _BUCKET.fullmatch(bucket):
            raise ValueError("the bucket is missing or has no valid name: https://host[:port]/bucket")
        if not _FOLDER.fullmatch(folder) or parts.query or parts.fragment or ".." in folder.split("/"):
            raise ValueError("the folder of the bucket may have letters, digits, ., _, - and /")
        return value

    @field_validator("object_store_public")
    @classmethod
    def _public_origin(cls, value: str) -> str:
        # It becomes a part of the content security policy.
        parts = urlsplit(value)
        if value and (
            parts.scheme not in {"http", "https"}
            or not _HOST.fullmatch(parts.netloc)
            or parts.path.strip("/")
            or parts.query
            or parts.fragment
        ):
            raise ValueError("this must be https://host[:port], without a path")
        return f"{parts.scheme}://{parts.netloc.lower()}" if value else value

    @model_validator(mode="after")
    def _complete_store(self) -> Self:
        if bool(self.object_store_key.get_secret_value()) != bool(
            self.object_store_secret.get_secret_value()
        ):
            raise ValueError("BT_STUDIO_OBJECT_STORE_KEY and BT_STUDIO_OBJECT_STORE_SECRET belong together")
        return self
