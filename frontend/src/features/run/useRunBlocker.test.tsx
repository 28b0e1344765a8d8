import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { useRunStore } from '@/store/run/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { account } from '../../../harness/requests';
import { fakeServer, show } from '../../../harness/testing';
import { useRunBlocker } from './useRunBlocker';

function Page() {
  return <p>blocked by {useRunBlocker() ?? 'nothing'}</p>;
}

const role = (of: 'driver' | 'viewer') =>
  act(() => useSessionStore.setState({ introspection: { role: of } as typeof initialSession.introspection }));

it.each([
  ['guest', 'driver', 'guest'],
  ['guest', 'viewer', 'guest'],
  ['user', 'viewer', 'viewer'],
  ['user', 'driver', null],
] as const)('for a %s who is %s of the session is %s', async (who, of, blocker) => {
  onTestFinished(() => {
    useSessionStore.setState(initialSession, true);
    useRunStore.setState(useRunStore.getInitialState(), true);
  });
  fakeServer({ 'GET /me': account({ role: who }) });
  show(<Page />);
  role(of);
  expect(await screen.findByText(`blocked by ${blocker ?? 'nothing'}`)).toBeInTheDocument();
  expect(useRunStore.getState().runBlocker).toBe(blocker);
});
