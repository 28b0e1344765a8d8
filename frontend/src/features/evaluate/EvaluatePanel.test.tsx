import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { firstEvaluation } from '@/model/evaluation/files';
import { useProjectStore } from '@/store/project';
import { evaluation } from '../../../harness/evaluations';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { EvaluatePanel } from './EvaluatePanel';

const allowed = { may_start: true, may_replay: true, why_not: '' };

function open(items: object[], rights: object = allowed, names = ['room']) {
  const texts = Object.fromEntries(
    names.map((name) => [`evaluations/${name}.yaml`, firstEvaluation('walled_room')]),
  );
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts });
  const at = `/projects/${useProjectStore.getState().projectId}/evaluations`;
  const { requests } = fakeServer({
    [`GET ${at}`]: { items, costs: [], ...rights },
    [`POST ${at}`]: evaluation({ id: 'e9' }),
    [`GET ${at}/e1/outcomes?revision=7&after=0`]: { items: [], cursor: 0 },
  });
  show(<EvaluatePanel />);
  return requests;
}

it('starts the chosen evaluation with as many runs as asked', async () => {
  const requests = open([]);
  await user.type(await screen.findByLabelText('Runs'), '5');
  await user.click(screen.getByRole('button', { name: 'Evaluate' }));
  expect(requests.find(({ method }) => method === 'POST')?.body).toEqual({
    name: 'room',
    runs: 5,
    sealed: false,
  });
});

it('shows the newest evaluation, and edits the file in a form', async () => {
  open([evaluation(), evaluation({ id: 'e2', name: 'hall' })]);
  expect(await screen.findByRole('heading', { name: /^room/ })).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Edit' }));
  expect(screen.getByTestId('evaluation-form')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Done' }));
  expect(screen.getByRole('heading', { name: /^room/ })).toBeInTheDocument();
});

it('offers viewers to look alone, and says why a server evaluates nothing', async () => {
  open([evaluation()], { may_start: false, may_replay: true, why_not: 'one_place' });
  expect(await screen.findByRole('note')).toHaveTextContent('one place for robots');
  for (const name of ['Evaluate', 'Edit', 'New…', 'Cancel'])
    expect(screen.queryByRole('button', { name })).toBeNull();
});

it('begins with a form for the first evaluation', async () => {
  open([], allowed, []);
  await user.click(await screen.findByRole('button', { name: 'Make the evaluation' }));
  expect(screen.getByTestId('evaluation-form')).toHaveTextContent('evaluations/room.yaml');
});
