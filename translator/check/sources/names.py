"""Names that a source uses and nothing defines."""

from __future__ import annotations

import builtins
from typing import TYPE_CHECKING, Final

from translator.check.sources.found import Found, Moment, found_at

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.check.sources.scopes import Scopes

_MODULE: Final = frozenset(
    ("__name__", "__file__", "__doc__", "__package__", "__spec__", "__loader__", "__builtins__")
) | frozenset(("__annotations__", "__debug__"))
_KNOWN: Final = frozenset(dir(builtins)) | _MODULE
_DYNAMIC: Final = frozenset({"globals", "exec", "vars", "locals", "builtins", "__builtins__", "__import__"})
"""Names whose use may define others while the module runs."""


def unknown_names(scopes: Scopes) -> Iterator[Found]:
    """Yields each use of a name that does not exist, or not yet; the first one of each name."""
    if is_dynamic(scopes):
        return
    told: set[tuple[str, bool]] = set()
    for use in scopes.uses:
        if use.name in _KNOWN:
            continue
        is_known = scopes.knows(use)
        early = scopes.is_early(use)
        if (is_known and not early) or (use.name, use.moment is Moment.LATER) in told:
            continue
        told.add((use.name, use.moment is Moment.LATER))
        if early:
            yield found_at("BT0641", use.node, use.moment, name=use.name)
        else:
            yield found_at("BT0640", use.node, use.moment, name=use.name)


def is_dynamic(scopes: Scopes) -> bool:
    """Returns whether code defines names in a way that cannot be read."""
    return scopes.has_star or any(use.name in _DYNAMIC for use in scopes.uses)
