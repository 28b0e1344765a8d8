import { IconFlag } from '@tabler/icons-react';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { registerCommands } from './registry';
import { bindShortcuts } from './shortcuts';

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
