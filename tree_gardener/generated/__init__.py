"""Generated code for ticks: one Python function for a composite and the plain nodes below it.

The function does what happens most: the composite starts, and every child returns SUCCESS or FAILURE within
the tick. For everything else (RUNNING, SKIPPED, a condition that decides, an exception) it calls `Recovery`,
which continues in the nodes' own methods. Statuses, marks of observers and counts are written by the function
at the moments at which the nodes' methods write them.

* `parts` describes a region: what is inlined, what is called, and the values that the code needs.
* `writer` makes the syntax of a region, of `ast` nodes only.
* `code` compiles it, once for each shape, and binds it to the nodes.
* `recovery` continues where a function leaves the usual way.
* `generation` decides when and for which nodes this is done.
"""
