/** Searches beside the page: an expression that takes without end is stopped with this worker. */
import { seek, type SearchAnswer, type SearchRequest } from '@/model/search/seek';

export function answer({ data }: Pick<MessageEvent<SearchRequest>, 'data'>): void {
  const found: SearchAnswer = seek(data);
  (self as unknown as Worker).postMessage(found);
}

self.onmessage = answer;
