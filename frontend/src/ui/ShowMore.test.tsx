import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../harness/testing';
import { ShowMore } from './ShowMore';

it('takes clicks while a page is loaded, and keeps the focus', async () => {
  const onClick = vi.fn();
  const { rerender } = show(
    <ShowMore isLoading={false} onClick={onClick}>
      More
    </ShowMore>,
  );
  await user.click(screen.getByRole('button', { name: 'More' }));
  rerender(
    <ShowMore isLoading onClick={onClick}>
      More
    </ShowMore>,
  );
  const button = screen.getByRole('button', { name: 'More' });
  expect(button).toHaveFocus();
  expect(button).toHaveAttribute('aria-busy', 'true');
  await user.click(button);
  expect(onClick).toHaveBeenCalledTimes(2);
});
