import { activateHover, EditorView, hasHoverTooltips, hoverTooltip } from '@codemirror/view';
import { expect, it, onTestFinished, vi } from 'vitest';
import { escapeClosesHover } from './hoverEscape';

it('Escape closes what a pointer shows, and is of others where nothing is shown', () => {
  const help = hoverTooltip(() => ({ pos: 0, create: () => ({ dom: document.createElement('p') }) }));
  const view = new EditorView({
    doc: 'Behaviour',
    extensions: [help, escapeClosesHover],
    parent: document.body,
  });
  onTestFinished(() => view.destroy());
  const others = vi.fn();
  window.addEventListener('keydown', others);
  onTestFinished(() => window.removeEventListener('keydown', others));
  const press = (key: string) =>
    document.body.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true }));
  activateHover(view, 1, 1);
  expect(hasHoverTooltips(view.state)).toBe(true);
  press('a');
  expect([hasHoverTooltips(view.state), others.mock.calls.length]).toEqual([true, 1]);
  expect(press('Escape')).toBe(false);
  expect([hasHoverTooltips(view.state), others.mock.calls.length]).toEqual([false, 1]);
  press('Escape');
  expect(others).toHaveBeenCalledTimes(2);
});
