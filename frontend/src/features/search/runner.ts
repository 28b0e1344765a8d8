import type { SearchAnswer, SearchRequest } from '@/model/search/seek';

/** The time after which an expression counts as one that takes without end. */
export const DEADLINE_MS = 5000;

export type Outcome = SearchAnswer | 'too-slow' | 'replaced';

const makeWorker = () => new Worker(new URL('./searchWorker.ts', import.meta.url), { type: 'module' });

/** Searches in a worker, one request at a time: a new one replaces the one before. */
export class SearchRunner {
  private worker: Worker | null = null;
  private stop: ((outcome: Outcome) => void) | null = null;

  constructor(private readonly make: () => Worker = makeWorker) {}

  /** Resolves with the hits, or why there are none; never rejects. */
  run(request: SearchRequest): Promise<Outcome> {
    this.stop?.('replaced');
    const worker = (this.worker ??= this.make());
    return new Promise((done) => {
      const finish = (outcome: Outcome): void => {
        clearTimeout(timer);
        this.stop = null;
        if (typeof outcome === 'string') this.drop();
        done(outcome);
      };
      const timer = setTimeout(() => finish('too-slow'), DEADLINE_MS);
      this.stop = finish;
      worker.onmessage = ({ data }: MessageEvent<SearchAnswer>) => finish(data);
      worker.onerror = () => finish('too-slow');
      worker.postMessage(request);
    });
  }

  /** Ends the worker, and what it is doing. */
  end(): void {
    if (this.stop) this.stop('replaced');
    else this.drop();
  }

  private drop(): void {
    this.worker?.terminate();
    this.worker = null;
  }
}
