import { IconFlag } from '@tabler/icons-react';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { registerCommands } from './registry';
import { bindShortcuts, readKeyboard, shortcutLabel } from './shortcuts';

const run = vi.fn();
let unbind = () => {};
let unregister = () => {};

beforeEach(() => {
  run.mockClear();
  unregister = registerCommands([
    { id: 'test.back', group: 'run', labelKey: 'axis:command.live', icon: IconFlag, shortcut: 'Escape', run },
  ]);
  unbind = bindShortcuts(window);
});

afterEach(() => {
  unbind();
  unregister();
  document.body.replaceChildren();
});

function press(inner: string, key = 'Escape'): void {
  document.body.innerHTML = inner;
  const target = document.querySelector('[data-here]') ?? document.body;
  target.dispatchEvent(new KeyboardEvent('keydown', { key, code: key, bubbles: true, cancelable: true }));
}

describe('bindShortcuts', () => {
  it('runs a command by its key', () => {
    press('<button data-here>A</button>');
    expect(run).toHaveBeenCalledOnce();
  });

  it.each([
    '<div role="menu"><button data-here>A</button></div>',
    '<div role="dialog"><button data-here>A</button></div>',
    '<div role="listbox"><span data-here>A</span></div>',
    '<button aria-haspopup="menu" aria-expanded="true" data-here>A</button>',
  ])('leaves Escape to what it closes: %s', (open) => {
    press(open);
    expect(run).not.toHaveBeenCalled();
  });

  it('leaves keys to a field of text', () => {
    press('<input data-here />');
    expect(run).not.toHaveBeenCalled();
  });
});

describe('shortcutLabel', () => {
  afterEach(() => readKeyboard({ getLayoutMap: () => Promise.resolve(new Map()) }));

  it('names keys by what an American keyboard has on them', () => {
    const codes = [
      'Alt+BracketLeft',
      'Alt+Shift+BracketRight',
      'Alt+Equal',
      'Alt+Minus',
      'Alt+Digit0',
      'Escape',
    ];
    expect(codes.map(shortcutLabel)).toEqual(['Alt+[', 'Alt+Shift+]', 'Alt+=', 'Alt+-', 'Alt+0', 'Esc']);
  });

  it('names keys by what is printed on those of the user', async () => {
    const layout = new Map([
      ['Slash', '-'],
      ['Backquote', 'º'],
      ['KeyZ', 'y'],
    ]);
    await readKeyboard({ getLayoutMap: () => Promise.resolve(layout) });
    expect(['$mod+Slash', '$mod+Backquote', '$mod+KeyZ', 'F5'].map(shortcutLabel)).toEqual([
      'Ctrl+-',
      'Ctrl+º',
      'Ctrl+Y',
      'F5',
    ]);
  });

  it('keeps the names where the browser refuses the layout', async () => {
    await readKeyboard({ getLayoutMap: () => Promise.reject(new Error('no')) });
    await readKeyboard(undefined);
    expect(shortcutLabel('Alt+KeyM')).toBe('Alt+M');
  });
});
