"""Functions that read a request, shared by all views of the API."""

from __future__ import annotations

from threading import local
from typing import TYPE_CHECKING, Any, Final

from rest_framework.exceptions import ValidationError

from backend.accounts.models import User

if TYPE_CHECKING:
    from rest_framework import serializers
    from rest_framework.request import Request

_threads: Final = local()


def parsed(serializer: type[serializers.Serializer[Any]], data: Any) -> dict[str, Any]:
    """Returns the checked values of a request.

    Raises DRF's ValidationError, which names the first invalid value.
    """
    try:
        return dict(_reader(serializer).run_validation(data))
    except ValidationError:
        # Errors are rare, so this may be slow: a new serializer makes DRF's error text.
        bound = serializer(data=data)
        bound.is_valid(raise_exception=True)
        return dict(bound.validated_data)


def _reader(serializer: type[serializers.Serializer[Any]]) -> serializers.Serializer[Any]:
    """Returns this thread's serializer, since making one takes longer than reading most requests."""
    readers: dict[type[serializers.Serializer[Any]], serializers.Serializer[Any]]
    readers = _threads.__dict__.setdefault("readers", {})
    if serializer not in readers:
        readers[serializer] = serializer()
    return readers[serializer]


def user_of(request: Request) -> User:
    """Returns the user of the request. The permission classes guarantee that a user exists."""
    assert isinstance(request.user, User)  # noqa: S101 - for the type checker
    return request.user


def if_match(request: Request) -> str:
    """Returns the `If-Match` header, which names the base of a write; "" if the header is missing."""
    return request.headers.get("If-Match", "")
