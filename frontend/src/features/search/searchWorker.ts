/**
 * Runs searches beside the page. If an expression takes forever, the page stops the search by ending this
 * worker.
 */
import { seek, type SearchAnswer, type SearchRequest } from '@/model/search/seek';

export function answer({ data }: Pick<MessageEvent<SearchRequest>, 'data'>): void {
  const found: SearchAnswer = seek(data);
  (self as unknown as Worker).postMessage(found);
}

self.onmessage = answer;
