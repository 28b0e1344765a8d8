import { act, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { openRunsDialog } from '@/store/dialogs/runs';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { RunsDialog } from './RunsDialog';

it('asks for the runs when it opens, and closes', async () => {
  const { requests } = fakeServer({ 'GET /projects/p1/runs': { items: [] } });
  openProject({});
  show(<RunsDialog />);
  expect(requests).toEqual([]);
  act(openRunsDialog);
  expect(await screen.findByRole('dialog', { name: 'Kept runs' })).toBeInTheDocument();
  expect(await screen.findByText(/No run has been kept yet/)).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Close the kept runs' }));
  expect(screen.queryByRole('dialog')).toBeNull();
});
