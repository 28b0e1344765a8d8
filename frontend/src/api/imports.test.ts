import { expect, it } from 'vitest';
import { fakeServer } from '../../harness/testing';
import { imports } from './imports';

it('sends the file as the body, and each argument by its name', async () => {
  const { requests } = fakeServer({});
  const wish = { kind: 'robot', main: 'a.xacro', name: 'a', args: { r: '1', t: '2' } } as const;
  const more = { use: false, replace: false, simplify: false };
  const data = new Blob(['x']);
  const { signal } = new AbortController();
  await imports.take('p1', { name: 'a.zip', data }, { ...wish, ...more }, signal).catch(() => undefined);
  expect(requests[0]?.body).toBe(data);
  expect(new URLSearchParams(requests[0]?.path.split('?')[1]).getAll('arg')).toEqual(['r:=1', 't:=2']);
});
