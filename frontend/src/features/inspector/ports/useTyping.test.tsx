import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useLivePorts } from '@/store/run/livePorts';
import { show, user } from '../../../../harness/testing';
import { useTyping } from './useTyping';

function Field() {
  const { isTyping, handlers } = useTyping();
  return (
    <div {...handlers} data-testid="field" data-typing={isTyping}>
      <input aria-label="value" />
      <input type="checkbox" aria-label="switch" />
    </div>
  );
}
const isTyping = () => {
  const { isTyping: isHeld } = useLivePorts.getState();
  expect(screen.getByTestId('field')).toHaveAttribute('data-typing', String(isHeld));
  return isHeld;
};

it.each(['{Enter}', '{ArrowUp}', '{ArrowDown}', '{Tab}'])('a text is typed until %s', async (key) => {
  show(<Field />);
  await user.type(screen.getByLabelText('value'), '0.5');
  expect(isTyping()).toBe(true);
  await user.keyboard(key);
  expect(isTyping()).toBe(false);
});

it('a switch is not typed, and a field that is gone neither', async () => {
  const { unmount } = show(<Field />);
  await user.click(screen.getByLabelText('switch'));
  expect(isTyping()).toBe(false);
  await user.type(screen.getByLabelText('value'), '1');
  unmount();
  expect(useLivePorts.getState().isTyping).toBe(false);
});
