import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { evaluation } from '../../../harness/evaluations';
import { fakeServer, show, user } from '../../../harness/testing';
import { Comparison } from './Comparison';

const compared = evaluation({ older: 3, state: 'done' });
const answer = {
  difference: [-0.3, -0.5, -0.1],
  p: 0.01,
  both: 6,
  neither: 0,
  only_older: [4, 9],
  only_newer: [],
  measures: [{ name: 'path_length_m', pairs: 8, difference: [0.5, 0.1, 0.9] }],
};
const open = (body: object) => {
  fakeServer({ 'GET /projects/p1/evaluations/e1/comparison': body });
  const choose = vi.fn();
  show(<Comparison projectId="p1" evaluation={compared} mayReplay onChoose={choose} />);
  return choose;
};

it('says in plain words which revision is worse, and lists the seeds', async () => {
  const choose = open(answer);
  expect(await screen.findByText(/Revision 7 succeeds less often than 3/)).toHaveTextContent(
    'The rate changes by -30 % (95 % interval -50 % to -10 %); McNemar’s test: p = 0.01.',
  );
  expect(screen.getByText(/path_length_m: \+0.5/)).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: '9' }));
  expect(choose).toHaveBeenCalledWith(9);
});

it('claims no difference that is not shown', async () => {
  open({ ...answer, difference: [0, -0.2, 0.2], p: 1, only_older: [], measures: [] });
  expect(await screen.findByText(/No difference between the revisions 7 and 3 is shown/)).toBeInTheDocument();
  expect(screen.getByText('The outcomes of all 6 seeds are the same.')).toBeInTheDocument();
});
