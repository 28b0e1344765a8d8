"""What every view of the API shares."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from backend.accounts.models import User

if TYPE_CHECKING:
    from rest_framework import serializers
    from rest_framework.request import Request


def parsed(serializer: type[serializers.Serializer[Any]], data: Any) -> dict[str, Any]:
    """The checked values of a request; DRF's ValidationError tells the first that is wrong."""
    bound = serializer(data=data)
    bound.is_valid(raise_exception=True)
    values: dict[str, Any] = dict(bound.validated_data)
    return values


def user_of(request: Request) -> User:
    """Who asks; permissions have seen to it that there is someone."""
    assert isinstance(request.user, User)  # noqa: S101 - for the type checker
    return request.user


def if_match(request: Request) -> str:
    """The header that says on what a write is based; empty without one."""
    return request.headers.get("If-Match", "")
