import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useProjectStore } from '@/store/project';
import { evaluation } from '../../../harness/evaluations';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { earlierOf, isLive, useEvaluations } from './useEvaluations';

function P() {
  const { found, start } = useEvaluations(true);
  return (
    <button type="button" onClick={() => void start('room', 3, true)}>
      {found.data?.items.length ?? 'none'}
    </button>
  );
}

it('lists the evaluations of the project, and starts one', async () => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  const at = `/projects/${useProjectStore.getState().projectId}/evaluations`;
  const { requests } = fakeServer({
    [`GET ${at}`]: { items: [evaluation()], costs: [], may_start: true, may_replay: true, why_not: '' },
    [`POST ${at}`]: evaluation(),
  });
  show(<P />);
  await user.click(await screen.findByRole('button', { name: '1' }));
  expect(requests.find(({ method }) => method === 'POST')?.body).toEqual({
    name: 'room',
    runs: 3,
    sealed: true,
  });
});

it('tells a refusal, and what is live', async () => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  fakeServer({});
  show(<P />);
  await user.click(screen.getByRole('button'));
  expect(await screen.findByText('The evaluation was not started')).toBeInTheDocument();
  expect([isLive(evaluation()), isLive(evaluation({ state: 'done' }))]).toEqual([true, false]);
});

it('knows the revision that was evaluated before', () => {
  const shown = evaluation({ revision: 7 });
  const older = evaluation({ revision: 5 });
  const empty = evaluation({ revision: 6, sides: [] });
  const other = evaluation({ name: 'other', revision: 6 });
  expect(earlierOf(shown, [shown, empty, other, older])).toBe(5);
  expect(earlierOf(older, [shown, older])).toBeNull();
});
