import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { account } from '../../../harness/requests';
import { fakeServer, show } from '../../../harness/testing';
import { useFlagUser } from './useFlagUser';

function Shown() {
  return <p>flags of “{useFlagUser()}”</p>;
}

it.each([
  ['who signed in', { name: 'Ada Lovelace' }, 'Ada Lovelace'],
  ['a user without a full name', { name: '' }, 'ada'],
  ['nobody where there are no accounts', { mode: 'local' as const }, ''],
])('is the name of %s', async (_, more, name) => {
  const { requests } = fakeServer({ 'GET /me': account(more) });
  show(<Shown />);
  await expect.poll(() => requests.length).toBeGreaterThan(0);
  expect(await screen.findByText(`flags of “${name}”`)).toBeVisible();
});
