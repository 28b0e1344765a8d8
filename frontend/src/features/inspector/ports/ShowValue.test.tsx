import { screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { useShownValues } from '@/store/session/values/shown';
import { show, user } from '../../../../harness/testing';
import { ShowValue } from './ShowValue';

it('chooses whether the block shows the value', async () => {
  onTestFinished(() => useShownValues.setState({ ports: new Set() }));
  show(<ShowValue port="Main/a/speed" name="speed" />);
  const button = screen.getByRole('button', { name: 'Show the value of speed in the block' });
  expect(button).toHaveAttribute('aria-pressed', 'false');
  await user.click(button);
  expect([...useShownValues.getState().ports]).toEqual(['Main/a/speed']);
  expect(button).toHaveAttribute('aria-pressed', 'true');
  await user.click(button);
  expect(useShownValues.getState().ports.size).toBe(0);
});
