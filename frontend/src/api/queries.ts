import { QueryClient } from '@tanstack/react-query';

/** What the server said: shown at once when it is looked at again, and asked for anew each time. */
export const queries = new QueryClient({ defaultOptions: { queries: { retry: 1 } } });
