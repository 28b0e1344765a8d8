import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { TryForm } from './TryForm';

it('begins with the time for each, once that is right', async () => {
  const onBegin = vi.fn();
  const { rerender } = show(
    <TryForm values={['1', '2']} problem={null} onBegin={onBegin}>
      fields
    </TryForm>,
  );
  expect(screen.getByTestId('tries-preview')).toHaveTextContent('To try: 1, 2');
  await user.clear(screen.getByTestId('tries-duration'));
  await user.type(screen.getByTestId('tries-duration'), '121');
  expect(screen.getByTestId('tries-begin')).toBeDisabled();
  await user.clear(screen.getByTestId('tries-duration'));
  await user.type(screen.getByTestId('tries-duration'), '4');
  await user.click(screen.getByTestId('tries-begin'));
  expect(onBegin).toHaveBeenCalledExactlyOnceWith(4);
  rerender(
    <TryForm values={['fast']} problem="bad" bad={['fast']} onBegin={onBegin}>
      fields
    </TryForm>,
  );
  expect(screen.getByTestId('tries-preview')).toHaveTextContent('The port does not take: fast');
  expect(screen.getByTestId('tries-begin')).toBeDisabled();
});
