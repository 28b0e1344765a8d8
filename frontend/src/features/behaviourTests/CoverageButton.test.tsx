import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { Evaluation, EvaluationSide } from '@/api/evaluations';
import { useCoverage } from '@/store/behaviourTests/coverage';
import { liveKey } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { CoverageButton } from './CoverageButton';

const items = (ticked: boolean) => ({ name: 'a', type: 'AlwaysSuccess', items: { ticked, SUCCESS: ticked } });
const coverage = {
  share: 0.5,
  trees: { Main: { share: 0.5, nodes: { r: items(true), a: items(false) } } },
};
const evaluation = { id: 'e1', name: 'room' } as Evaluation;
const side = { revision: 3, done: 50 } as EvaluationSide;

function open(answers: Parameters<typeof fakeServer>[0]) {
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } } });
  const id = useProjectStore.getState().projectId!;
  const path = `GET /projects/${id}/evaluations/e1/coverage?revision=3`;
  fakeServer(Object.fromEntries(Object.values(answers).map((answer) => [path, answer])));
  show(<CoverageButton projectId={id} evaluation={evaluation} side={side} />);
  return screen.getByRole('button', { name: 'Show on the canvas what the runs covered' });
}

it('shows on the canvas what the runs of a revision covered', async () => {
  await user.click(open({ coverage }));
  await expect.poll(() => useCoverage.getState().isShown).toBe(true);
  const { blocks, evaluated } = useCoverage.getState();
  expect(evaluated).toMatchObject({ name: 'room', revision: 3, runs: 50 });
  expect(blocks.get(liveKey('Main', 'r'))).toMatchObject({ level: 'fully' });
  expect(blocks.get(liveKey('Main', 'a'))).toMatchObject({ level: 'never' });
});

it('says why it cannot', async () => {
  await user.click(open({ answer: new Response('{"title":"No","detail":"Too busy."}', { status: 429 }) }));
  expect(await screen.findByText(/The coverage cannot be shown/)).toBeInTheDocument();
  expect(useCoverage.getState().isShown).toBe(false);
});
