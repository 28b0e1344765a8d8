import { QueryClient } from '@tanstack/react-query';

/** Cache of server data: a view shows the cached data at once and fetches it again. */
export const queries = new QueryClient({ defaultOptions: { queries: { retry: 1 } } });
