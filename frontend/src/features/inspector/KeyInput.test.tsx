import { screen } from '@testing-library/react';
import { useState } from 'react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { KeyInput } from './KeyInput';

function open(start = '', error: string | null = null) {
  const onChange = vi.fn();
  function Field() {
    const [value, setValue] = useState(start);
    return (
      <>
        <span id="label">goal</span>
        <KeyInput
          name="goal"
          labelledBy="label"
          value={value}
          keys={['goal', 'pose', 'speed']}
          error={error}
          onChange={(next) => {
            setValue(next);
            onChange(next);
          }}
        />
      </>
    );
  }
  show(<Field />);
  return { onChange, field: screen.getByTestId('port-goal') };
}

const options = () => screen.queryAllByRole('option').map(({ textContent }) => textContent);

describe('KeyInput', () => {
  it('has the label of its port, and shows how a key is written', () => {
    const { field } = open();
    expect(field).toHaveAccessibleName('goal');
    expect(field).toHaveAttribute('placeholder', '{goal}');
    expect(field).toBeValid();
    expect(screen.getByLabelText('Blackboard key')).toBeInTheDocument();
  });

  it('offers the keys of the tree that match the typed text', async () => {
    const { field, onChange } = open();
    await user.click(field);
    expect(options()).toEqual(['{goal}', '{pose}', '{speed}']);
    await user.keyboard('{{sp');
    expect(options()).toEqual(['{speed}']);
    await user.click(screen.getByRole('option'));
    expect(onChange).toHaveBeenLastCalledWith('{speed}');
    expect(field).toHaveValue('{speed}');
  });

  it('shows an error if the key is wrong', () => {
    expect(open('{', 'Bad.').field).toBeInvalid();
  });
});
