import { render, screen } from '@testing-library/react';
import { useRef, useState } from 'react';
import { describe, expect, it } from 'vitest';
import { user } from '../../../../harness/testing';
import { useKeptCaret } from './useKeptCaret';

function Field() {
  const [text, setText] = useState('ab');
  const host = useRef<HTMLDivElement>(null);
  const widget = text.includes('!') ? 'loud' : 'quiet';
  const kept = useKeptCaret(host, widget);
  return (
    <div ref={host} {...kept}>
      <input
        key={widget}
        aria-label={widget}
        value={text}
        onChange={(event) => {
          setText(event.currentTarget.value);
        }}
      />
      <button type="button" onClick={() => setText('a!b')}>
        shout
      </button>
    </div>
  );
}

describe('useKeptCaret', () => {
  it('continues where the text was typed that replaced the widget', async () => {
    render(<Field />);
    await user.type(screen.getByRole('textbox', { name: 'quiet' }), '!x', { initialSelectionStart: 1 });
    const loud = screen.getByRole<HTMLInputElement>('textbox', { name: 'loud' });
    expect(loud).toHaveFocus();
    expect(loud).toHaveValue('a!xb');
    expect(loud.selectionStart).toBe(3);
    await user.keyboard('{Backspace}{Backspace}');
    expect(screen.getByRole('textbox', { name: 'quiet' })).toHaveFocus();
  });

  it('takes the focus from no button', async () => {
    render(<Field />);
    await user.click(screen.getByRole('button', { name: 'shout' }));
    expect(screen.getByRole('button', { name: 'shout' })).toHaveFocus();
  });
});
