"""The controls of a page that a user sees at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from playwright.sync_api import Page

VISIBLE: Final = """() => {
  const CONTROLS = [
    'button', 'a[href]', 'input:not([type=hidden])', 'select', 'textarea', '[contenteditable=true]',
    'summary', '[role=button]', '[role=tab]', '[role=switch]', '[role=slider]', '[role=checkbox]',
    '[role=combobox]', '[tabindex="0"]', '.flexlayout__tab_button',
  ].join(',');
  const NOT = [
    '[role=menu]', '[role=option]', '[role=treeitem]', '[role=log] *', '.react-flow__node',
    '.react-flow__edge',
  ].join(',');
  const found = [];
  for (const each of document.querySelectorAll(CONTROLS)) {
    if (each.closest(NOT) || each.closest('[inert], [aria-hidden=true]')) continue;
    if (!each.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    const box = each.getBoundingClientRect();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    if (box.width < 2 || box.height < 2 || x < 0 || y < 0 || x > innerWidth || y > innerHeight) continue;
    const top = document.elementFromPoint(x, y);
    if (!top || !(each.contains(top) || top.contains(each))) continue;
    const holds = ({ element }) => element.contains(each) && element.matches('button, a, [role=tab]');
    if (found.some(holds)) continue;
    const part = each.closest('[data-testid], header, footer, nav, [role=tabpanel]');
    const name = each.getAttribute('aria-label') || each.title || each.textContent.trim() || each.tagName;
    found.push({ element: each, name: name.slice(0, 40), part: part?.dataset.testid ?? part?.tagName ?? '' });
  }
  return found.map(({ name, part }) => [part, name]);
}"""


def visible_controls(page: Page) -> list[tuple[str, str]]:
    """Returns part of the page and name of each element in sight that takes the focus or a click.

    Blocks of the tree, entries of menus and lines of the console do not count, nor what lies within
    another control.
    """
    return [(part, name) for part, name in page.evaluate(VISIBLE)]
