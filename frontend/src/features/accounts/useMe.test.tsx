import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { account } from '../../../harness/requests';
import { fakeServer, show } from '../../../harness/testing';
import { useMe } from './useMe';

function Name() {
  return <p>{useMe()?.user ?? 'not known yet'}</p>;
}

it('requests the signed-in user once', async () => {
  const { requests } = fakeServer({ 'GET /me': account() });
  const { unmount } = show(<Name />);
  expect(screen.getByText('not known yet')).toBeInTheDocument();
  expect(await screen.findByText('ada')).toBeInTheDocument();
  unmount();
  show(<Name />);
  expect(screen.getByText('ada')).toBeInTheDocument();
  expect(requests).toHaveLength(1);
});
