import { QueryClient, type QueryKey } from '@tanstack/react-query';

/** Cache of server data: a view shows the cached data at once and fetches it again. */
export const queries = new QueryClient({ defaultOptions: { queries: { retry: 1 } } });

/**
 * Fetches data again that a change made old. A first answer that is still on its way may be from before the
 * change, and `invalidateQueries` alone would take that one.
 */
export async function fetchAgain(client: QueryClient, queryKey: QueryKey): Promise<void> {
  await client.cancelQueries({ queryKey });
  await client.invalidateQueries({ queryKey });
}
