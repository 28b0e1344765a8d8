import { screen } from '@testing-library/react';
import { useState } from 'react';
import { describe, expect, it, vi } from 'vitest';
import type { PortSpec } from '@/model/ports';
import { port, show, user } from '../../../harness/testing';
import { ValueInput } from './ValueInput';

function open(type: string, value: string | null, more: Partial<PortSpec> = {}, error: string | null = null) {
  const onChange = vi.fn();
  function Field() {
    const [now, setNow] = useState(value);
    return (
      <>
        <span id="label">speed</span>
        <ValueInput
          port={{ ...port('speed', type), ...more } as PortSpec}
          labelledBy="label"
          value={now}
          keys={[]}
          error={error}
          onChange={(next) => {
            setNow(next);
            onChange(next);
          }}
        />
      </>
    );
  }
  show(<Field />);
  return { onChange, field: () => screen.getByTestId('port-speed') };
}

describe('a number', () => {
  it.each([
    ['1', '{ArrowUp}', '2'],
    ['1', '{ArrowDown}', '0'],
    ['0.30', '{ArrowUp}', '0.31'],
    ['-0.1', '{ArrowUp}{ArrowUp}', '0.1'],
    ['2.5', '{Shift>}{ArrowUp}{/Shift}', '3.5'],
    ['7', '{Shift>}{ArrowDown}{/Shift}', '-3'],
  ])('%s becomes, with %s, %s', async (value, keys, expected) => {
    const { field, onChange } = open('double', value);
    field().focus();
    await user.keyboard(keys);
    expect(onChange).toHaveBeenLastCalledWith(expected);
  });

  it.each(['int', 'double'])('of the type %s shows the numeric keyboard on phones', (type) => {
    expect(open(type, '1').field()).toHaveAttribute('inputmode', 'decimal');
  });

  it('steps from its default', async () => {
    const { field, onChange } = open('int', null, { default: '5' });
    expect(field()).toHaveAttribute('placeholder', 'Default: 5');
    field().focus();
    await user.keyboard('{ArrowUp}');
    expect(onChange).toHaveBeenLastCalledWith('6');
  });

  it('steps from zero without one', async () => {
    const { field, onChange } = open('int', null);
    expect(field()).toHaveAttribute('placeholder', '');
    field().focus();
    await user.keyboard('{ArrowUp}');
    expect(onChange).toHaveBeenLastCalledWith('1');
  });

  it('does not step an invalid number', async () => {
    const { field, onChange } = open('int', 'many');
    field().focus();
    await user.keyboard('{ArrowUp}{Home}');
    expect(onChange).not.toHaveBeenCalled();
  });

  it('is not set when it is empty', async () => {
    const { field, onChange } = open('double', '3');
    await user.clear(field());
    expect(onChange).toHaveBeenLastCalledWith(null);
  });
});

describe('a text', () => {
  it('may be empty, and has no steps', async () => {
    const { field, onChange } = open('string', '1');
    expect(field()).not.toHaveAttribute('inputmode');
    expect(field()).toHaveAccessibleName('speed');
    field().focus();
    await user.keyboard('{ArrowUp}');
    expect(onChange).not.toHaveBeenCalled();
    await user.clear(field());
    expect(onChange).toHaveBeenLastCalledWith('');
  });

  it('shows an error if it is wrong', () => {
    expect(open('string', 'a').field()).toBeValid();
  });

  it('shows an error', () => {
    expect(open('string', 'a', {}, 'Bad.').field()).toBeInvalid();
  });
});

describe('a boolean', () => {
  it.each([
    ['true', null, 'true'],
    ['TRUE', null, 'true'],
    ['1', null, 'true'],
    ['10', null, 'false'],
    ['false', 'true', 'false'],
    [null, 'true', 'true'],
    [null, null, 'false'],
  ])('of %s with the default %s is %s', (value, given, expected) => {
    open('bool', value, { default: given });
    expect(screen.getByRole('radio', { name: expected })).toBeChecked();
  });

  it('can be chosen', async () => {
    const { onChange } = open('bool', null);
    await user.click(screen.getByRole('radio', { name: 'true' }));
    expect(onChange).toHaveBeenCalledExactlyOnceWith('true');
  });
});

it('edits a script in its own editor', async () => {
  const { onChange } = open('script', null);
  expect(onChange).not.toHaveBeenCalled();
  expect(await screen.findByRole('textbox', { name: 'speed' })).toBeInTheDocument();
});

describe('an enumeration', () => {
  it('offers its names, and shows a number that was written', async () => {
    const { field, onChange } = open('Color[RED;GREEN]', '9');
    expect(field()).toHaveValue('9');
    await user.click(field());
    await user.click(screen.getByRole('option', { name: 'GREEN' }));
    expect(onChange).toHaveBeenLastCalledWith('GREEN');
  });
});
