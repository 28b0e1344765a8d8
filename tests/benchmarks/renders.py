"""Counts the blocks of the canvas that React renders, by the hook of its developer tools, in any build."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import BrowserContext, Page

# React calls this hook at every commit. A component rendered in it if its fibre carries the flag
# (1) that React sets for these very tools; a subtree that was passed over keeps its child.
_HOOK = """
window.rendered = { blocks: [], frames: [] };
const walk = (fiber) => {
  const before = fiber.alternate;
  const props = fiber.memoizedProps;
  if (typeof fiber.type === 'function' && props && (before === null || fiber.flags & 1)) {
    const { blocks, frames } = window.rendered;
    if ('words' in props && props.data?.node) blocks.push(props.id);
    else if (props.nodeTypes?.block && props.resizeObserver && props.id) frames.push(props.id);
  }
  if (before !== null && before.child === fiber.child) return;
  for (let child = fiber.child; child; child = child.sibling) walk(child);
};
window.__REACT_DEVTOOLS_GLOBAL_HOOK__ = {
  supportsFiber: true,
  renderers: new Map(),
  inject: () => 1,
  checkDCE() {},
  onCommitFiberRoot: (_id, root) => walk(root.current),
  onCommitFiberUnmount() {},
  onPostCommitFiberRoot() {},
};
"""


def count_renders(context: BrowserContext) -> None:
    """Counts in all pages that this context opens later."""
    context.add_init_script(_HOOK)


def rendered(page: Page) -> tuple[list[str], list[str]]:
    """Blocks, and React Flow's frames around them, rendered since the last time: an id for each render."""
    blocks, frames = page.evaluate(
        "() => { const { blocks, frames } = window.rendered;"
        " window.rendered = { blocks: [], frames: [] }; return [blocks, frames]; }"
    )
    return blocks, frames
