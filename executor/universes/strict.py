"""The base class of the parts of our documents: unknown keys and values of the wrong type are refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ConfigDict

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler
    from pydantic_core import CoreSchema

__all__ = ["Strict"]


def _strict(schema: Any) -> Any:
    if isinstance(schema, list):
        return [_strict(each) for each in schema]
    if isinstance(schema, tuple):
        return tuple(_strict(each) for each in schema)
    if not isinstance(schema, dict):
        return schema
    kind = schema.get("type")
    if kind in ("float", "bool"):
        return {**schema, "strict": True}
    if kind == "int":
        whole = {"type": "no-info", "function": _whole}
        return {"type": "function-before", "function": whole, "schema": {**schema, "strict": True}}
    return {key: value if key == "metadata" else _strict(value) for key, value in schema.items()}


def _whole(value: Any) -> Any:
    return int(value) if isinstance(value, float) and value.is_integer() else value


class Strict(BaseModel):
    """A part of a document. No text becomes a number, and 1e2 is a whole number."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Returns the schema with its numbers and flags strict; lists stay allowed where tuples are meant."""
        schema: CoreSchema = _strict(handler(source))
        return schema
