import { act, screen } from '@testing-library/react';
import { useState } from 'react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { ScriptInput } from './ScriptInput';

let setText: (text: string) => void;

function open(start: string) {
  const onChange = vi.fn();
  function Field() {
    const [value, setValue] = useState(start);
    setText = setValue;
    return <ScriptInput label="While" testId="script" value={value} keys={[]} onChange={onChange} />;
  }
  show(<Field />);
  return onChange;
}
const error = () => screen.queryByTestId('script-error');

describe('ScriptInput', () => {
  it('is a plain field until the editor is loaded', async () => {
    const onChange = open('x := 1');
    const field = screen.getByRole('textbox', { name: 'While' });
    const isPlain = field.tagName === 'TEXTAREA';
    if (isPlain) {
      expect(field).toHaveValue('x := 1');
      await user.type(field, ';');
      expect(onChange).toHaveBeenCalledWith('x := 1;');
    }
    await vi.waitUntil(() => document.querySelector('.cm-editor'));
    expect(screen.getByTestId('script')).toBeInTheDocument();
    const editor = screen.getByRole('textbox', { name: 'While' });
    expect(editor).toHaveTextContent('x := 1');
    // Who types already continues in the editor, and not on the canvas.
    if (isPlain) expect(editor).toHaveFocus();
  });

  it('shows below the field what is wrong with the script at once', () => {
    open('x := 1');
    expect(error()).toBeNull();
    act(() => setText('x % 2'));
    expect(error()).toHaveTextContent("'%' has no meaning here: there is no remainder");
    act(() => setText('x := 2'));
    expect(error()).toBeNull();
  });

  it.each(['', '  '])('leaves an empty script “%s” to the list of problems', (text) => {
    open(text);
    expect(error()).toBeNull();
  });
});
