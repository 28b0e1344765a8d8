import { act, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useSessionStore } from '@/store/session/store';
import { debugged, hold, withTreeToHold } from '../../../harness/heldTree';
import { openSession, show, user } from '../../../harness/testing';
import { ForcedList } from './ForcedList';

withTreeToHold();

it('lists all that is forced', async () => {
  const executor = await openSession();
  hold('driver');
  show(<ForcedList />);
  expect(screen.queryByTestId('forced-list')).toBeNull();
  act(() =>
    useSessionStore.setState({
      forced: { nodes: [{ uid: 2, status: 'RUNNING', once: false, after: false, skips_to: 0 }], alone: 1 },
    }),
  );
  expect(screen.getAllByRole('listitem').map((item) => item.textContent)).toEqual([
    'rIt runs alone, in place of the root, until it is released.Release',
    'aIt is frozen as RUNNING, until it is released.Release',
  ]);
  await user.click(screen.getAllByRole('button', { name: 'Release' })[1]!);
  expect(debugged(executor)).toMatchObject([{ command: 'release', data: { uid: 2 } }]);
});
