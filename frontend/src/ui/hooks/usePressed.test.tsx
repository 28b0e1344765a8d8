import { fireEvent, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { usePressed } from './usePressed';

function Sample() {
  const { isPressed, handlers } = usePressed();
  return <button {...handlers}>{isPressed ? 'pressed' : 'free'}</button>;
}

it('lasts from a press until the pointer leaves', () => {
  show(<Sample />);
  const button = screen.getByRole('button');
  fireEvent.pointerDown(button);
  fireEvent.pointerUp(button);
  expect(button).toHaveTextContent('pressed');
  fireEvent.pointerLeave(button);
  expect(button).toHaveTextContent('free');
});
