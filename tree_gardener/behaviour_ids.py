"""The random ids of py_trees' behaviours, in a fifth of the time.

The constructor of each behaviour makes a UUID, which asks the operating system for 16 bytes: two thirds of
the constructor's time, and a third of the time in which a tree is loaded. Ids tell the behaviours of one
process apart and keep no secret, so a generator seeded by the operating system is enough.
"""

import os
import random
from typing import Any, Final
from uuid import UUID, SafeUUID

from py_trees import behaviour

_VERSION_4: Final = (4 << 76) | (2 << 62)
_FIXED_BITS: Final = (0xF << 76) | (3 << 62)
_FREE_BITS: Final = ((1 << 128) - 1) ^ _FIXED_BITS
_source: Final = random.Random()  # noqa: S311 - no secret; not the generator that users seed
_bits = _source.getrandbits
_new = UUID.__new__
_UNKNOWN: Final = SafeUUID.unknown
_set_number: Any = UUID.__dict__["int"].__set__
_set_safe: Any = UUID.__dict__["is_safe"].__set__


def random_id() -> UUID:
    """Returns a random UUID, as `uuid.uuid4`."""
    made = _new(UUID)
    _set_number(made, _bits(128) & _FREE_BITS | _VERSION_4)
    _set_safe(made, _UNKNOWN)
    return made


class Ids:
    """Replaces the module `uuid` for the module of py_trees' behaviours."""

    UUID = UUID
    uuid4 = staticmethod(random_id)


def install() -> None:
    """Makes py_trees take the ids of its behaviours from here."""
    vars(behaviour)["uuid"] = Ids


os.register_at_fork(after_in_child=_source.seed)
