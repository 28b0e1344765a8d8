import { expect, it } from 'vitest';
import { fakeServer } from '../../harness/testing';
import { runs } from './runs';

it('makes the calls for the runs of a project', async () => {
  const { requests } = fakeServer({
    'GET /projects/p1/runs': { items: [{ id: 'r1' }] },
    'POST /projects/p1/runs': { id: 'r2' },
    'PATCH /projects/p1/runs/r1': { id: 'r1' },
    'DELETE /projects/p1/runs/r1': new Response(null, { status: 204 }),
  });
  expect(await runs.list('p1')).toEqual([{ id: 'r1' }]);
  expect(await runs.keep('p1', { run: 'a1', name: 'n', note: '' })).toEqual({ id: 'r2' });
  await runs.change('p1', 'r1', { is_pinned: true });
  await runs.remove('p1', 'r1');
  expect(requests.map(({ method, path }) => `${method} ${path}`)).toEqual([
    'GET /projects/p1/runs',
    'POST /projects/p1/runs',
    'PATCH /projects/p1/runs/r1',
    'DELETE /projects/p1/runs/r1',
  ]);
  expect(runs.recordingUrl('p1', 'r1')).toBe('/api/v1/projects/p1/runs/r1/recording');
});
