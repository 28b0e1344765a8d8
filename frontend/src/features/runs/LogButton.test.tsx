import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { LogButton } from './LogButton';

it('opens the chosen file, and shows that it is being read', async () => {
  let finish: () => void = () => undefined;
  const onOpen = vi.fn(
    () =>
      new Promise<void>((resolve) => {
        finish = resolve;
      }),
  );
  const { container } = show(<LogButton onOpen={onOpen} />);
  const button = screen.getByRole('button', { name: 'Open a log of a robot…' });
  const input = container.ownerDocument.querySelector('input[type=file]') as HTMLInputElement;
  expect(input.accept).toContain('.btlog');
  const file = new File(['x'], 'f.btlog');
  await user.upload(input, file);
  expect(onOpen).toHaveBeenCalledWith(file);
  expect(button).toHaveAttribute('data-loading');
  finish();
  await expect.poll(() => button.hasAttribute('data-loading')).toBe(false);
  await user.upload(input, file);
  expect(onOpen).toHaveBeenCalledTimes(2);
});
