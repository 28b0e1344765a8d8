import type { SearchAnswer, SearchRequest } from '@/model/search/seek';

/** The time in ms after which a search is stopped, since its expression may take forever. */
export const DEADLINE_MS = 5000;

export type Outcome = SearchAnswer | 'too-slow' | 'replaced';

const makeWorker = () => new Worker(new URL('./searchWorker.ts', import.meta.url), { type: 'module' });

/** Runs searches in a worker, one at a time: a new request cancels the previous one. */
export class SearchRunner {
  private worker: Worker | null = null;
  private stop: ((outcome: Outcome) => void) | null = null;

  constructor(private readonly make: () => Worker = makeWorker) {}

  /** Resolves with the hits, or with the reason why there are none; never rejects. */
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

  /** Stops the worker, and the search that it runs. */
  end(): void {
    if (this.stop) this.stop('replaced');
    else this.drop();
  }

  private drop(): void {
    this.worker?.terminate();
    this.worker = null;
  }
}
