"""The payload of a goal as entries of the blackboard."""

import json
from typing import Any, Final

from tree_gardener.blackboard import Blackboard

PAYLOAD: Final = "payload"


class PayloadError(ValueError):
    """A payload that cannot be read; the text says where and why."""


def blackboard_of(payload: str) -> Blackboard:
    """Returns the root blackboard for the tree of a goal.

    The entry ``payload`` holds the text. If it is a JSON object, each of its members is an entry too.

    Raises:
        PayloadError: the text is not JSON, or a member cannot be an entry.
    """
    board = Blackboard()
    for key, value in entries_of(payload).items():
        board[key] = value
    board[PAYLOAD] = payload
    return board


def entries_of(payload: str) -> dict[str, Any]:
    """Returns the members of a JSON object; nothing for another value of JSON, or for an empty text.

    Raises:
        PayloadError: as for `blackboard_of`.
    """
    if not payload.strip():
        return {}
    kind = "a JSON object" if payload.lstrip().startswith("{") else "JSON"
    try:
        values = json.loads(payload, parse_constant=_refuse)
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}"
        raise PayloadError(f"the payload is not {kind}: {error.msg} ({place})") from error
    except (RecursionError, ValueError) as error:
        raise PayloadError(f"the payload is not {kind}: {error}") from error
    if not isinstance(values, dict):
        return {}
    for key, value in values.items():
        if not key or key[0] in "@_" or any(character.isspace() for character in key):
            raise PayloadError(
                f"the payload has the member {key!r}, which cannot be the name of an entry:"
                " use letters, digits and _"
            )
        if value is None:
            raise PayloadError(f"the payload's member {key!r} is null: leave it out, or give it a value")
    return dict(values)


def _refuse(word: str) -> Any:
    raise ValueError(f"{word} is not a number of JSON")
