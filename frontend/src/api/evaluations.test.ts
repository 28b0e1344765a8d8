import { expect, it } from 'vitest';
import { fakeServer } from '../../harness/testing';
import { evaluations } from './evaluations';

it('asks for outcomes from a cursor on, and names files by revision', async () => {
  const { requests } = fakeServer({
    'GET /projects/p/evaluations/e/outcomes?revision=3&after=9': { items: [], cursor: 9 },
  });
  expect((await evaluations.outcomes('p', 'e', 3, 9)).cursor).toBe(9);
  expect(requests).toHaveLength(1);
  expect(evaluations.linesUrl('p', 'e', 3)).toContain('/projects/p/evaluations/e/runs.jsonl?revision=3');
});
