const BARS = '.flexlayout__tabset_tabbar_outer';
const INNER = '.flexlayout__tabset_tabbar_inner';
const TAB = '.flexlayout__tab_button';
const NAME = '.flexlayout__tab_button_content';

/** An icon that stands for a name shows it to the pointer. */
function nameIcons(bar: HTMLElement): void {
  for (const icon of bar.querySelectorAll('[data-panel-icon]')) {
    const tab = icon.closest<HTMLElement>(TAB);
    if (tab) tab.title = bar.hasAttribute('data-cut') ? (tab.querySelector(NAME)?.textContent ?? '') : '';
  }
}

/**
 * Marks each bar of tabs that has no room for the names of its tabs; a style sheet then shows icons.
 *
 * The mark is removed before measuring, since the names must be written out to be measured.
 */
export function markCutTabs(root: ParentNode): void {
  const bars = [...root.querySelectorAll<HTMLElement>(BARS)];
  for (const bar of bars) bar.removeAttribute('data-cut');
  const cut = bars.filter((bar) => {
    const inner = bar.querySelector<HTMLElement>(INNER);
    return inner !== null && inner.scrollWidth > inner.clientWidth;
  });
  for (const bar of cut) bar.setAttribute('data-cut', '');
  for (const bar of bars) nameIcons(bar);
}
