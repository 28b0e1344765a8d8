import { onTestFinished, vi } from 'vitest';
import { seek, type SearchAnswer, type SearchRequest } from '@/model/search/seek';
import { useSearchStore } from '@/features/search/searchStore';

/** A worker that searches in the thread of the test. */
class FakeWorker {
  onmessage: ((event: { data: SearchAnswer }) => void) | null = null;

  postMessage(request: SearchRequest): void {
    queueMicrotask(() => this.onmessage?.({ data: seek(request) }));
  }

  terminate(): void {
    this.onmessage = null;
  }
}

/** Searches without a worker, from an empty form, until the test ends. */
export function searchHere(): void {
  const start = useSearchStore.getInitialState();
  vi.stubGlobal('Worker', FakeWorker);
  onTestFinished(() => {
    useSearchStore.setState(start, true);
    vi.unstubAllGlobals();
  });
}
