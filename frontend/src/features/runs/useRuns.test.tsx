import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { useRuns } from './useRuns';

function Probe() {
  const { found, remove } = useRuns();
  return <button onClick={() => void remove('r1')}>{String(found.data?.length)}</button>;
}

it('reads the list again after each change, and reports one that failed', async () => {
  const { requests } = fakeServer({
    'GET /projects/p1/runs': { items: [] },
    'DELETE /projects/p1/runs/r1': refusal('There is no such run.', { status: 404 }),
  });
  openProject({});
  show(<Probe />);
  await user.click(await screen.findByRole('button', { name: '0' }));
  expect(await screen.findByText('The run was not deleted')).toBeInTheDocument();
  expect(screen.getByText('There is no such run.')).toBeInTheDocument();
  expect(requests.map(({ method }) => method)).toEqual(['GET', 'DELETE', 'GET']);
});
