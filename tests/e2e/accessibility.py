"""Accessibility of a screen, checked by axe-core."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import TimeoutError as WaitedTooLongError

if TYPE_CHECKING:
    from playwright.sync_api import Page

    from tests.e2e.studio import Studio

# Colours that still fade in are not the page's final colours.
STILL = "*, ::before, ::after { transition: none !important; animation: none !important }"
AXE = Path(__file__).parents[2] / "frontend" / "node_modules" / "axe-core" / "axe.min.js"


def expect_accessible(studio: Studio, scheme: str) -> None:
    """Sets a theme and runs axe-core: findings of any weight fail."""
    if studio.page.locator("html").get_attribute("data-mantine-color-scheme") != scheme:
        if studio.at("theme-toggle").count():
            studio.at("theme-toggle").click()
        else:  # the basic page has it in a menu
            studio.command(f"{scheme} theme")
        studio.page.wait_for_selector(f"html[data-mantine-color-scheme={scheme}]")
    expect_no_findings(studio.page, scheme)


def expect_no_findings(page: Page, name: str, part: str | None = None) -> None:
    """Runs axe-core on a page as it is, or on the parts of it that a selector names."""
    page.add_style_tag(content=STILL)
    _load_axe(page)
    found = page.evaluate(
        # An open menu belongs to its button, though it is drawn at the end of the page. ARIA has no landmark
        # for it, and the rule excepts dialogues alone. An element of Mantine without content, which is no
        # item, has the focus of a menu until an arrow key is pressed.
        "async part => { axe.configure({rules: ["
        "{id: 'region', selector: 'body :not([role=menu], [role=menu] *, [data-portal]:has([role=menu]))'},"
        "{id: 'aria-required-children', selector: '[role]:not([role=menu]:has(> [data-autofocus]))'}]});"
        " return (await axe.run({"
        # Elements behind an open dialogue are not reachable.
        "include: part ?? document.querySelector('[role=dialog][aria-modal=true]') ?? document,"
        # The tooltip of the button that was pressed may open late, and is in no landmark.
        " exclude: [['[role=tooltip]'], ['[data-portal]:has([role=tooltip])']]},"
        # The size of targets, 24 by 24 px, is a rule that axe leaves out by itself.
        # No rule that is on reads style sheets: axe would fetch all of them each time.
        " {resultTypes: ['violations'], preload: {assets: ['media']},"
        " rules: {'target-size': {enabled: true}}})).violations"
        ".map(each => `${each.id}: `"
        " + each.nodes.map(n => n.target.join(' ') + ' — ' + n.failureSummary).join(' | ')) }",
        part,
    )
    assert not found, f"axe-core, {name}:\n" + "\n".join(found)
    small = page.evaluate(SMALL)
    assert not small, f"{name}: targets under 24 by 24 px:\n" + "\n".join(small)


def _load_axe(page: Page) -> None:
    if not page.evaluate("'axe' in window"):
        page.evaluate(AXE.read_text(encoding="utf-8"))


def expect_a_heading(page: Page, name: str) -> None:
    """The page has a heading of level one, which axe judges for whole pages alone."""
    _load_axe(page)
    found = page.evaluate(
        "async () => (await axe.run(document.documentElement, {runOnly: ['page-has-heading-one']}))"
        ".violations.map(each => each.help)"
    )
    assert not found, f"axe-core, {name}: {found}"


# Targets under 24 by 24 px. A field's label belongs to it; blocks on the canvas grow with the zoom.
SMALL = """() => {
  const root = document.querySelector('[role=dialog][aria-modal=true]') ?? document;
  const kinds = ['button', 'tab', 'menuitem', 'option', 'switch', 'checkbox', 'radio', 'slider', 'link'];
  const targets = root.querySelectorAll(
    'button, a[href], input, select, textarea, summary, ' + kinds.map((kind) => `[role=${kind}]`).join());
  const size = (element) => {
    const boxes = [element, ...(element.labels ?? [])].map((each) => each.getBoundingClientRect());
    return {
      width: Math.max(...boxes.map(({ right }) => right)) - Math.min(...boxes.map(({ left }) => left)),
      height: Math.max(...boxes.map(({ bottom }) => bottom)) - Math.min(...boxes.map(({ top }) => top)),
    };
  };
  return [...targets].filter((each) => {
    const { width, height } = each.getBoundingClientRect();
    if (width <= 1 || height <= 1 || each.closest('.react-flow__viewport, [aria-hidden=true]')) return false;
    if (!each.checkVisibility({ visibilityProperty: true })) return false;
    const isInSentence = each.matches('a') && getComputedStyle(each).display === 'inline';
    const { width: wide, height: high } = size(each);
    return !isInSentence && (wide < 23.5 || high < 23.5);
  }).map((each) => {
    const { width, height } = each.getBoundingClientRect();
    return `${Math.round(width)} x ${Math.round(height)}: ${each.outerHTML.slice(0, 160)}`;
  });
}"""


# Controls outside of the window, unless a scrolling element contains them.
BEYOND = """() => {
  const scrolls = (element) => {
    for (let at = element.parentElement; at; at = at.parentElement)
      if (/auto|scroll/.test(getComputedStyle(at).overflowX) && at.scrollWidth > at.clientWidth) return true;
    return Boolean(element.closest('.react-flow__viewport'));
  };
  const out = [...document.querySelectorAll('button, input, a, select, [role=tab]')].filter((element) => {
    const { left, right, width, height } = element.getBoundingClientRect();
    return width && height && (right > innerWidth + 1 || left < -1) && !scrolls(element);
  });
  const page = document.scrollingElement.scrollWidth - innerWidth;
  const found = out.map((each) => each.outerHTML.slice(0, 150));
  return page > 0 ? [`the page is ${page} px too wide`, ...found] : found;
}"""


def expect_to_fit(page: Page, name: str) -> None:
    """Nothing of a page is outside of its window, where it could not be reached, once it has its new size."""
    try:
        page.wait_for_function(f"() => ({BEYOND})().length === 0")
    except WaitedTooLongError:
        beyond = page.evaluate(BEYOND)
        raise AssertionError(
            f"{name} does not fit into {page.viewport_size}:\n" + "\n".join(beyond)
        ) from None


# The focused element looks different from its unfocused state: itself, or its outline.
FOCUS = """() => {
  const element = document.activeElement;
  if (!element || element === document.body) return null;
  const look = () => {
    const boxes = [element, element.parentElement, element.parentElement?.parentElement];
    return [...boxes, null].map((box) => {
      const style = getComputedStyle(box ?? element, box ? null : '::before');
      return [style.outline, style.boxShadow, style.borderColor, style.backgroundColor].join();
    }).join('|');
  };
  const focused = look();
  element.blur();
  const unseen = look() === focused;
  element.focus({ preventScroll: true });
  return { unseen, what: element.outerHTML.slice(0, 160) };
}"""


def expect_focus_to_show(page: Page, name: str, stops: int) -> None:
    """Walks a page by Tab: at each stop the focus is visible."""
    page.add_style_tag(content=STILL)
    seen = set()
    for _ in range(stops):
        page.keyboard.press("Tab")
        at = page.evaluate(FOCUS)
        if at:
            seen.add(at["what"])
            assert not at["unseen"], f"{name}: the focus cannot be seen on {at['what']}"
    assert len(seen) > stops / 2, f"{name}: Tab leads to {len(seen)} places only"
