import { describe, expect, it, vi } from 'vitest';
import { seek, type SearchAnswer, type SearchRequest } from '@/model/search/seek';
import { DEADLINE_MS, SearchRunner } from './runner';

/** A worker that runs in the test's thread; with `hangs` it never answers. */
class FakeWorker {
  isEnded = false;
  onmessage: ((event: { data: SearchAnswer }) => void) | null = null;

  constructor(private readonly hangs = false) {}

  postMessage(request: SearchRequest): void {
    if (!this.hangs) queueMicrotask(() => this.isEnded || this.onmessage?.({ data: seek(request) }));
  }

  terminate(): void {
    this.isEnded = true;
  }
}

const request = (text: string): SearchRequest => ({
  query: { text, matchesCase: false, isWholeWord: false, isRegex: false },
  replacement: null,
  texts: ['a b'],
});

function runnerOf(...workers: FakeWorker[]): SearchRunner {
  const left = [...workers];
  return new SearchRunner(() => left.shift() as unknown as Worker);
}

describe('SearchRunner', () => {
  it('answers, and keeps its worker', async () => {
    const runner = runnerOf(new FakeWorker());
    expect(await runner.run(request('a'))).toMatchObject({ hits: [{ start: 0 }] });
    expect(await runner.run(request('b'))).toMatchObject({ hits: [{ start: 2 }] });
  });

  it('stops an endless search, and works after that', async () => {
    vi.useFakeTimers();
    const stuck = new FakeWorker(true);
    const runner = runnerOf(stuck, new FakeWorker());
    const outcome = runner.run(request('a'));
    vi.advanceTimersByTime(DEADLINE_MS);
    vi.useRealTimers();
    expect(await outcome).toBe('too-slow');
    expect(stuck.isEnded).toBe(true);
    expect(await runner.run(request('a'))).toMatchObject({ isCut: false });
  });

  it('cancels a search for the next one', async () => {
    const stuck = new FakeWorker(true);
    const runner = runnerOf(stuck, new FakeWorker());
    const first = runner.run(request('a'));
    const second = runner.run(request('b'));
    expect(await first).toBe('replaced');
    expect(stuck.isEnded).toBe(true);
    expect(await second).toMatchObject({ hits: [{ start: 2 }] });
  });

  it('ends its worker', async () => {
    const idle = new FakeWorker();
    const runner = runnerOf(idle);
    await runner.run(request('a'));
    runner.end();
    expect(idle.isEnded).toBe(true);
  });
});
