import { cleanup, screen } from '@testing-library/react';
import { useState } from 'react';
import { describe, expect, it, vi } from 'vitest';
import type { PortSpec } from '@/model/ports';
import { port, show, user } from '../../../harness/testing';
import { PortField } from './PortField';

interface FieldProps {
  readonly spec: PortSpec;
  readonly start?: string | null;
  readonly onChange: (value: string | null) => void;
}

function Field({ spec, start = null, onChange }: FieldProps) {
  const [value, setValue] = useState(start);
  const change = (next: string | null) => {
    setValue(next);
    onChange(next);
  };
  return (
    <PortField
      port={spec}
      value={value}
      keys={['goal', 'pose']}
      error={null}
      shown={`Main/a/${spec.name}`}
      taken={[]}
      onRenameKey={onRenameKey}
      onChange={change}
    />
  );
}

const onRenameKey = vi.fn();

/** Shows the field; returns its input and a function for the last reported value. */
function field(spec: Partial<PortSpec>, start: string | null = null) {
  const onChange = vi.fn();
  show(<Field spec={{ ...port('x', 'double'), ...spec } as PortSpec} start={start} onChange={onChange} />);
  const last = (): unknown => onChange.mock.lastCall?.[0];
  return { last, onChange, input: () => screen.getByTestId<HTMLInputElement>('port-x') };
}

describe('PortField', () => {
  it.each([
    ['{goal}', 'goal'],
    ['{@goal}', '@goal'],
    ['{=}', 'x'],
  ])('with %s offers to rename the key %s everywhere', async (text, key) => {
    field({}, text);
    await user.click(screen.getByRole('button', { name: 'Rename this key everywhere…' }));
    expect(onRenameKey).toHaveBeenLastCalledWith(key);
  });

  it('does not offer to rename a missing key', () => {
    field({}, '0.5');
    expect(screen.queryByRole('button', { name: /^Rename this key/ })).toBeNull();
  });

  it('shows the default of a port that is not set', () => {
    const { input } = field({ default: '0.3', description: 'How fast.' });
    expect(input()).toHaveValue('');
    expect(input()).toHaveAttribute('placeholder', 'Default: 0.3');
    expect(input()).toHaveAccessibleName('x');
    expect(screen.getByText('How fast.')).toBeVisible();
    expect(screen.queryByRole('button', { name: 'Back to the default' })).toBeNull();
  });

  it('names the type, the direction and whether a value is required', () => {
    field({ type: 'string', direction: 'output', required: true });
    expect(screen.getByText('text · out · required')).toBeVisible();
  });

  it('steps a number by its last decimal, and ten times that with Shift', async () => {
    const { input, last } = field({ default: '0.30' });
    input().focus();
    await user.keyboard('{ArrowUp}');
    expect(last()).toBe('0.31');
    await user.keyboard('{ArrowDown}{ArrowDown}');
    expect(last()).toBe('0.29');
    await user.keyboard('{Shift>}{ArrowUp}{/Shift}');
    expect(last()).toBe('0.39');
  });

  it('steps from zero without a default, and does not step invalid numbers', async () => {
    const { input, last } = field({ type: 'int' });
    input().focus();
    await user.keyboard('{ArrowDown}');
    expect(last()).toBe('-1');
    await user.clear(input());
    expect(last()).toBeNull();
    await user.keyboard('ab{ArrowUp}');
    expect(last()).toBe('ab');
  });

  it('keeps an empty text as a value', async () => {
    const { input, last } = field({ type: 'string' }, 'a');
    await user.clear(input());
    expect(last()).toBe('');
    await user.keyboard('{ArrowUp}');
    expect(last()).toBe('');
  });

  it('offers true and false', async () => {
    const { last } = field({ type: 'bool', default: 'true' });
    expect(screen.getByRole('radio', { name: 'true' })).toBeChecked();
    await user.click(screen.getByRole('radio', { name: 'false' }));
    expect(last()).toBe('false');
    expect(screen.getByRole('radio', { name: 'false' })).toBeChecked();
  });

  it('reads 1 as true', () => {
    field({ type: 'bool', default: 'false' }, '1');
    expect(screen.getByRole('radio', { name: 'true' })).toBeChecked();
  });

  it('changes a value into a key of the port’s name, and back into the default', async () => {
    const { last } = field({ default: '0.3' }, '2');
    await user.click(screen.getByRole('button', { name: 'Use a blackboard key' }));
    expect(last()).toBe('{x}');
    const back = screen.getByRole('button', { name: 'Use a fixed value' });
    expect(back).toHaveAttribute('aria-pressed', 'true');
    await user.click(back);
    expect(last()).toBe('0.3');
  });

  it('completes a key from the keys of the tree', async () => {
    const { input, last } = field({}, '{');
    await user.click(input());
    await user.keyboard('go');
    await user.click(screen.getByRole('option', { name: '{goal}' }));
    expect(last()).toBe('{goal}');
  });

  it('keeps the caret while a typed brace makes a value a key, and back', async () => {
    const { input, last } = field({ default: '0.3' });
    await user.type(input(), '{{goal}');
    expect(input()).toHaveFocus();
    expect(last()).toBe('{goal}');
    await user.keyboard('{Backspace>6/}');
    expect(input()).toHaveFocus();
    await user.keyboard('7');
    expect(last()).toBe('7');
  });

  it('keeps the caret in an output whose key has no braces yet', async () => {
    const { input, last } = field({ direction: 'output', type: 'string' });
    await user.type(input(), 'side');
    expect(input()).toHaveFocus();
    expect(last()).toBe('side');
  });

  it('accepts only a key for an output', () => {
    const { input } = field({ direction: 'output' });
    expect(input()).toHaveAttribute('placeholder', '{x}');
    expect(screen.queryByRole('button', { name: /Use a/ })).toBeNull();
  });

  it('resets the default', async () => {
    const { last } = field({ default: '0.3' }, '2');
    await user.click(screen.getByRole('button', { name: 'Back to the default' }));
    expect(last()).toBeNull();
  });

  it('has no reset for a required port', () => {
    field({ required: true }, '2');
    expect(screen.queryByRole('button', { name: 'Back to the default' })).toBeNull();
  });

  it('offers to show its value in the block where it names a key', () => {
    const name = 'Show the value of x in the block';
    field({}, '{goal}');
    expect(screen.getByRole('button', { name })).toHaveAttribute('aria-pressed', 'false');
    cleanup();
    field({ default: '{=}' });
    expect(screen.getByRole('button', { name })).toBeInTheDocument();
    cleanup();
    field({}, '2');
    expect(screen.queryByRole('button', { name })).toBeNull();
  });
});
