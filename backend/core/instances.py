"""Instances of models from rows of hand-written SQL: what Django's `raw` does, without its price a query."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from django.db import connection
from django.db.models import Model

if TYPE_CHECKING:
    from collections.abc import Sequence

M = TypeVar("M", bound=Model)


class _Columns(NamedTuple):
    names: list[str]
    sql: str
    converters: list[tuple[int, Any, Any]]
    """Where the database does not have a value as we do: index of the column, expression, functions."""


def columns(model: type[Model]) -> str:
    """All columns of a model, each with its table, as a query names them that `instance` reads."""
    return _columns(connection.vendor, model).sql


def instance(model: type[M], row: Sequence[Any]) -> M:
    """The instance whose `columns` the row begins with."""
    found = _columns(connection.vendor, model)
    values = list(row[: len(found.names)])
    for index, expression, functions in found.converters:
        for function in functions:
            values[index] = function(values[index], expression, connection)
    return model.from_db(connection.alias, found.names, values)


@lru_cache(maxsize=16)
def _columns(vendor: str, model: type[Model]) -> _Columns:
    table, names, columns, converters = model._meta.db_table, [], [], []
    for index, field in enumerate(model._meta.concrete_fields):
        expression = field.get_col(table)
        functions = connection.ops.get_db_converters(expression) + expression.get_db_converters(connection)
        converters += [(index, expression, functions)] if functions else []
        names.append(field.attname)
        columns.append(f"{connection.ops.quote_name(table)}.{field.column}")
    return _Columns(names, ", ".join(columns), converters)
