import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useSource } from '@/store/moment/source';
import { outcome } from '../../../harness/evaluations';
import { fakeServer, show, user } from '../../../harness/testing';
import { useReplay } from './useReplay';

function P() {
  const { seed, play, cancel } = useReplay('p1', 'e1');
  return (
    <>
      <button type="button" onClick={() => void play(7, outcome(3))}>
        {seed ?? 'idle'}
      </button>
      <button type="button" onClick={() => void cancel()}>
        stop
      </button>
    </>
  );
}
const replay = { id: 'r1', seed: 3, revision: 7, error: '', run: null };
const RUN = '11111111-1111-1111-1111-111111111111';

it('opens the recorded run once it is there', async () => {
  fakeServer({
    'POST /projects/p1/evaluations/e1/replays': { ...replay, state: 'waiting' },
    'GET /projects/p1/evaluations/e1/replays/r1': { ...replay, state: 'done', run: RUN },
    [`GET /projects/p1/runs/${RUN}`]: { id: RUN, name: 'room, seed 3', start_s: 0, length_s: 20 },
  });
  show(<P />);
  await user.click(screen.getByRole('button', { name: 'idle' }));
  expect(screen.getByRole('button', { name: '3' })).toBeInTheDocument();
  expect(await screen.findByRole('button', { name: 'idle' }, { timeout: 3000 })).toBeInTheDocument();
  expect(useSource.getState().kept?.id).toBe(RUN);
});

it('says why a run cannot be played', async () => {
  fakeServer({
    'POST /projects/p1/evaluations/e1/replays': { ...replay, state: 'failed', error: 'no room' },
  });
  show(<P />);
  await user.click(screen.getByRole('button', { name: 'idle' }));
  expect(await screen.findByText('The run of seed 3 cannot be played')).toBeInTheDocument();
  expect(screen.getByText('no room')).toBeInTheDocument();
});

it('takes the wish back', async () => {
  useSource.setState({ kept: null });
  const { requests } = fakeServer({
    'POST /projects/p1/evaluations/e1/replays': { ...replay, state: 'waiting' },
    'GET /projects/p1/evaluations/e1/replays/r1': { ...replay, state: 'waiting' },
    'DELETE /projects/p1/evaluations/e1/replays/r1': null,
  });
  show(<P />);
  await user.click(screen.getByRole('button', { name: 'idle' }));
  await waitFor(() => expect(requests).toHaveLength(1));
  await user.click(screen.getByRole('button', { name: 'stop' }));
  expect(screen.getByRole('button', { name: 'idle' })).toBeInTheDocument();
  await waitFor(() => expect(requests.at(-1)?.method).toBe('DELETE'));
  expect(useSource.getState().kept).toBeNull();
});
