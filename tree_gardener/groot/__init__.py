"""Groot2's protocol: a tree that runs here is followed, held and forced by Groot2.

* `protocol` has the messages, `document` the description of a tree, `mirror` the copies of its state.
* `hooks` holds the tree at breakpoints and forces results.
* `answers` answers requests, and `publisher` serves them.

```python
with tree.publish_groot2():
    tree.tick_while_running()
```
"""

from typing import TYPE_CHECKING

from tree_gardener.lazy import lazy_package

if TYPE_CHECKING:
    from tree_gardener.groot.protocol import GrootError
    from tree_gardener.groot.publisher import PORT, Groot2Publisher

__all__ = ["PORT", "Groot2Publisher", "GrootError"]

lazy_package(
    __name__,
    {
        "tree_gardener.groot.protocol": "GrootError",
        "tree_gardener.groot.publisher": "PORT Groot2Publisher",
    },
)
