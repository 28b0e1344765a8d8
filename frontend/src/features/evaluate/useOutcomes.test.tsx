import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { evaluation, outcome } from '../../../harness/evaluations';
import { fakeServer, show } from '../../../harness/testing';
import { useOutcomes } from './useOutcomes';

const AT = 'GET /projects/p1/evaluations/e1/outcomes?revision=7';

function P() {
  const { rows } = useOutcomes('p1', evaluation(), 7);
  return <p>{[...rows.keys()].join(' ')}</p>;
}

it('reads on from the cursor while the evaluation runs', async () => {
  const { requests } = fakeServer({
    [`${AT}&after=0`]: { items: [outcome(1), outcome(0)], cursor: 5 },
    [`${AT}&after=5`]: { items: [outcome(2)], cursor: 9 },
    [`${AT}&after=9`]: { items: [], cursor: 9 },
  });
  show(<P />);
  expect(await screen.findByText('1 0')).toBeInTheDocument();
  expect(await screen.findByText('1 0 2', undefined, { timeout: 4000 })).toBeInTheDocument();
  expect(requests.slice(0, 2).map(({ path }) => path.split('after=')[1])).toEqual(['0', '5']);
});
