import { afterEach, expect, it, vi } from 'vitest';
import type { StoredRun } from '@/api/runs';
import { storedSource } from './storedSource';

const run = { id: '12-ab', start_s: 2, length_s: 3, size: 100 } as StoredRun;

afterEach(() => vi.unstubAllGlobals());

it('is one segment that has ended', () => {
  const source = storedSource('p1', run);
  expect(source.segments()).toEqual([
    {
      run: '12ab',
      branch: 0,
      number: 0,
      version: 0,
      from_t: 2,
      to_t: 5,
      bytes: 100,
      complete: true,
      run_number: 1,
      result: null,
    },
  ]);
  expect(source.subscribe(vi.fn())()).toBeUndefined();
  // The server answers at most 8 MiB at once.
  expect(source.partBytes).toBeLessThanOrEqual(8 << 20);
});

it('reads a range of the file', async () => {
  const fetched = vi.fn().mockResolvedValue(new Response(new Uint8Array([1, 2]), { status: 206 }));
  vi.stubGlobal('fetch', fetched);
  const source = storedSource('p1', run);
  expect(await source.read(source.segments()[0]!, 10, 2)).toEqual(new Uint8Array([1, 2]));
  expect(fetched).toHaveBeenCalledWith('/api/v1/projects/p1/runs/12-ab/recording', {
    headers: { Range: 'bytes=10-11' },
  });
});

it('fails if the server gives anything else', async () => {
  vi.stubGlobal('fetch', vi.fn().mockResolvedValue(new Response('all', { status: 200 })));
  const source = storedSource('p1', run);
  await expect(source.read(source.segments()[0]!, 0, 2)).rejects.toThrow('cannot be read (200)');
});
