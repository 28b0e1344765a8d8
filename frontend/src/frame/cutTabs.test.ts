import { describe, expect, it } from 'vitest';
import { markCutTabs } from './cutTabs';

/** Returns a bar of tabs with the width that it has for names, and the width that they need. */
function bar(root: HTMLElement, has: number, needs: number): HTMLElement {
  const outer = document.createElement('div');
  const inner = document.createElement('div');
  outer.className = 'flexlayout__tabset_tabbar_outer';
  inner.className = 'flexlayout__tabset_tabbar_inner';
  Object.defineProperty(inner, 'clientWidth', { value: has, writable: true });
  Object.defineProperty(inner, 'scrollWidth', {
    // Icons need less room than names.
    get: () => (outer.hasAttribute('data-cut') ? 10 : needs),
  });
  outer.append(inner);
  root.append(outer);
  return outer;
}

describe('markCutTabs', () => {
  it('marks the bars whose names do not fit, and keeps the mark while they do not', () => {
    const root = document.createElement('div');
    const [cut, whole] = [bar(root, 200, 260), bar(root, 200, 200)];
    markCutTabs(root);
    markCutTabs(root);
    expect([cut.hasAttribute('data-cut'), whole.hasAttribute('data-cut')]).toEqual([true, false]);
  });

  it('gives the icons that stand for names these names', () => {
    const root = document.createElement('div');
    const outer = bar(root, 200, 260);
    const tab = document.createElement('div');
    tab.className = 'flexlayout__tab_button';
    tab.innerHTML = '<svg data-panel-icon></svg><span class="flexlayout__tab_button_content">Outline</span>';
    outer.append(tab);
    markCutTabs(root);
    expect(tab.title).toBe('Outline');
    Object.assign(outer.firstElementChild as object, { clientWidth: 300 });
    markCutTabs(root);
    expect(tab.title).toBe('');
  });

  it('removes the mark when there is room again', () => {
    const root = document.createElement('div');
    const outer = bar(root, 200, 260);
    markCutTabs(root);
    Object.assign(outer.firstElementChild as object, { clientWidth: 300 });
    markCutTabs(root);
    expect(outer.hasAttribute('data-cut')).toBe(false);
  });
});
