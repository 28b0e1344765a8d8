import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import * as connection from '@/store/session/connection';
import { SeedsForm } from './SeedsForm';

it('says what a seed changes, and tries so many of them', async () => {
  const send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  show(<SeedsForm moment={{ run: 'a', t: 3.25 }} />);
  expect(screen.getByText(/noise of sensors and wheels/)).toBeVisible();
  expect(screen.getByTestId('tries-preview')).toHaveTextContent('To try: 1, 2, 3, 4, 5');
  await user.clear(screen.getByTestId('tries-first-seed'));
  expect(screen.getByTestId('tries-begin')).toBeDisabled();
  await user.type(screen.getByTestId('tries-first-seed'), '40');
  await user.clear(screen.getByTestId('tries-seed-count'));
  await user.type(screen.getByTestId('tries-seed-count'), '2');
  await user.click(screen.getByTestId('tries-begin'));
  expect(send).toHaveBeenCalledWith(
    'try_seeds',
    expect.objectContaining({ run: 'a', t: 3.25, seeds: [40, 41], duration_s: 10 }),
  );
});
