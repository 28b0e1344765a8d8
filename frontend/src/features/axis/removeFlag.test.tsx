import { notifications } from '@mantine/notifications';
import { screen } from '@testing-library/react';
import { afterEach, expect, it, vi } from 'vitest';
import * as connection from '@/store/session/connection';
import { show, user } from '../../../harness/testing';
import { removeFlag } from './removeFlag';

afterEach(() => {
  vi.restoreAllMocks();
  notifications.clean();
});

const flag = { run: 'a', id: 'f1', t: 2, text: 'here' };

it('is undone by setting the flag again', async () => {
  const send = vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  show(<main />);
  removeFlag(flag, 'Ada');
  expect(await screen.findByText('The flag “here” at 2.00 s is removed')).toBeVisible();
  await user.click(screen.getByRole('button', { name: 'Undo' }));
  expect(send.mock.calls).toEqual([
    ['flag', { ...flag, text: '', user: '' }],
    ['flag', { ...flag, id: '', user: 'Ada' }],
  ]);
});

it('says why it is refused', async () => {
  vi.spyOn(connection, 'send').mockRejectedValue(new Error('This flag is not there any more.'));
  show(<main />);
  removeFlag(flag, '');
  expect(await screen.findByText('This flag is not there any more.')).toBeVisible();
});
