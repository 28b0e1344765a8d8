/** Searches beside the page: an expression that takes without end is stopped with this worker. */
import { seek, type SearchAnswer, type SearchRequest } from '@/model/search/seek';

const answer = (found: SearchAnswer) => (self as unknown as Worker).postMessage(found);

self.onmessage = ({ data }: MessageEvent<SearchRequest>) => answer(seek(data));
