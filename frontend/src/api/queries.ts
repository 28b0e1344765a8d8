import { QueryClient } from '@tanstack/react-query';

/** Server data: shown at once from the cache when it is opened again, and fetched again each time. */
export const queries = new QueryClient({ defaultOptions: { queries: { retry: 1 } } });
