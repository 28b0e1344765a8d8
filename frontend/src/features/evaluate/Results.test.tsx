import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { evaluation, outcome } from '../../../harness/evaluations';
import { fakeServer, show, user } from '../../../harness/testing';
import { Results } from './Results';

const done = evaluation({ state: 'done', left_s: null });
const bad = outcome(1, { outcome: 'failure', margin: -0.2, why: 'never collision' });
const answers = {
  'GET /projects/p1/evaluations/e1/outcomes?revision=7&after=0': { items: [outcome(0), bad], cursor: 5 },
};

it('shows the worst run, its reason, and plays it', async () => {
  const { requests } = fakeServer({
    ...answers,
    'POST /projects/p1/evaluations/e1/replays': { id: 'r1', state: 'failed', error: 'no room', run: null },
  });
  show(<Results projectId="p1" evaluation={done} mayReplay />);
  expect(await screen.findByText('never collision')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Seed 1: failure after 20 s, margin -0.2 m' }));
  expect(screen.getByTestId('evaluation-cell')).toHaveTextContent(/^Seed 1: failure/);
  await user.click(screen.getAllByRole('button', { name: 'Play the run of seed 1' })[0]!);
  expect(await screen.findByText('no room')).toBeInTheDocument();
  await waitFor(() =>
    expect(requests.find(({ method }) => method === 'POST')?.body).toEqual({ revision: 7, seed: 1 }),
  );
});

it('plays the run of a seed whose outcome changed, as the revision that is shown', async () => {
  const side = done.sides[0]!;
  const compared = evaluation({ state: 'done', older: 3, sides: [side, { ...side, revision: 3 }] });
  const older = [outcome(0), outcome(1)];
  const { requests } = fakeServer({
    ...answers,
    'GET /projects/p1/evaluations/e1/outcomes?revision=3&after=0': { items: older, cursor: 5 },
    'GET /projects/p1/evaluations/e1/comparison': {
      ...{ difference: [-0.5, -0.9, 0], p: 0.5, both: 1, neither: 0 },
      ...{ only_older: [1], only_newer: [], measures: [] },
    },
    'POST /projects/p1/evaluations/e1/replays': { id: 'r1', state: 'failed', error: 'no room', run: null },
  });
  show(<Results projectId="p1" evaluation={compared} mayReplay />);
  const asked = () => requests.filter(({ method }) => method === 'POST').map(({ body }) => body);
  await screen.findByText('never collision');
  await user.click(await screen.findByRole('button', { name: '1' }));
  expect(screen.getByTestId('evaluation-cell')).toHaveTextContent(/^Seed 1: failure/);
  await waitFor(() => expect(asked()).toEqual([{ revision: 7, seed: 1 }]));
  await user.click(screen.getByText('Revision 3'));
  await screen.findByText(/Seed 1: success/);
  await user.click(screen.getByRole('button', { name: '1' }));
  await waitFor(() => expect(asked().at(-1)).toEqual({ revision: 3, seed: 1 }));
});

it('offers guests no play, and shows why an evaluation failed', async () => {
  fakeServer(answers);
  const failed = evaluation({ state: 'failed', error: 'evaluations/room.yaml:3:1: no' });
  show(<Results projectId="p1" evaluation={failed} mayReplay={false} />);
  expect(screen.getByText('evaluations/room.yaml:3:1: no')).toBeInTheDocument();
  expect(await screen.findByText('never collision')).toBeInTheDocument();
  expect(screen.queryByRole('button', { name: /Play/ })).toBeNull();
});
