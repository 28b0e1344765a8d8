import { act, screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { account } from '../../../harness/requests';
import { fakeServer, show } from '../../../harness/testing';
import { SharedRightsNotice } from './SharedRightsNotice';

async function open(usersRunAsServer: boolean) {
  const { requests } = fakeServer({ 'GET /me': account({ users_run_as_server: usersRunAsServer }) });
  show(<SharedRightsNotice />);
  await waitFor(() => expect(requests).not.toEqual([]));
  await act(() => Promise.resolve());
}

it('warns where the Python of every user runs as the server', async () => {
  await open(true);
  expect(await screen.findByTestId('shared-rights')).toHaveTextContent(/can read and change your projects/);
});

it('says nothing where users are isolated', async () => {
  await open(false);
  expect(screen.queryByTestId('shared-rights')).toBeNull();
});
