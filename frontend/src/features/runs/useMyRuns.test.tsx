import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { refusal } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { useMyRuns } from './useMyRuns';

function Probe() {
  const { found, remove } = useMyRuns();
  return (
    <button type="button" onClick={() => void remove('r1')}>
      {found.data?.length ?? 'none'}
    </button>
  );
}

it('lists the runs again after a deletion, and says why one failed', async () => {
  const answers: Record<string, unknown> = {
    'GET /runs': { items: [{ id: 'r1' }] },
    'DELETE /runs/r1': refusal('It is being read.'),
  };
  fakeServer(answers);
  show(<Probe />);
  const button = await screen.findByRole('button', { name: '1' });
  await user.click(button);
  expect(await screen.findByText('The run was not deleted')).toBeInTheDocument();
  expect(screen.getByText(/It is being read/)).toBeInTheDocument();
  answers['DELETE /runs/r1'] = undefined;
  answers['GET /runs'] = { items: [] };
  await user.click(button);
  expect(await screen.findByRole('button', { name: '0' })).toBeInTheDocument();
});
