"""Python's garbage collector while a tree is loaded.

A load makes many objects and no garbage in rings. The collector would look at all of them again and again, so
that a tree of twice the size took more than twice the time; and once more at the end, for a quarter of all.
"""

import contextlib
import gc
from collections.abc import Iterator
from typing import Final

LARGE: Final = 20_000
"""The new objects from which the last look at them is left out."""
MOST: Final = 500_000
"""The objects that may be left out before the collector looks at all there are: trees that were dropped
meanwhile are in rings."""


class _Unseen:
    """Counts the objects that the collector has not looked at since its last full pass."""

    def __init__(self) -> None:
        self.objects = 0
        self.passes = 0

    def add(self, objects: int) -> bool:
        """Counts more objects; returns whether the collector may do without a look at them."""
        passes = gc.get_stats()[-1]["collections"]
        if passes != self.passes:
            self.objects, self.passes = 0, passes
        self.objects += objects
        return self.objects <= MOST


_unseen = _Unseen()


@contextlib.contextmanager
def paused_collector() -> Iterator[None]:
    """Pauses the collector; it runs again afterwards, also after an exception.

    The pause is that of one load: of loads that overlap on several threads, the first one ends it for all.
    """
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
        _age()
    finally:
        gc.enable()


def _age() -> None:
    """Counts many new objects as old ones, at which the collector looks rarely."""
    objects = gc.get_count()[0]
    if objects < LARGE or gc.get_freeze_count():
        return  # objects that a program froze would thaw
    if _unseen.add(objects):
        gc.freeze()
        gc.unfreeze()
    else:
        gc.collect()
