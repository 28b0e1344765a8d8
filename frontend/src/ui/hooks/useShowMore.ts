import { useEffect, useState } from 'react';

/** What a list of pages needs of its query. */
interface Paged {
  readonly data: { readonly pages: readonly unknown[] } | undefined;
  readonly hasNextPage: boolean;
  readonly isFetching: boolean;
  readonly isError: boolean;
  /** Whether `data` are those of the list before. */
  readonly isPlaceholderData: boolean;
  fetchNextPage(options: { readonly cancelRefetch: boolean }): Promise<unknown>;
  refetch(): Promise<unknown>;
}

/**
 * Returns a function that asks for one page more of a list, and whether such a page is under way.
 *
 * The wish is kept until its page is there: a list that is fetched again, since something in it has changed,
 * cancels a page that is on its way, and another wish may come while that is loaded.
 *
 * @param key What is listed; a wish does not pass to another list.
 */
export function useShowMore(found: Paged, key: string) {
  const { hasNextPage, isFetching, isError, fetchNextPage, refetch } = found;
  const shown = found.isPlaceholderData ? 0 : (found.data?.pages.length ?? 0);
  const [wish, setWish] = useState({ key, pages: 0 });
  const wanted = wish.key === key ? wish.pages : 0;
  const isLoadingMore = wanted > shown && hasNextPage && !isError;
  useEffect(() => {
    if (isLoadingMore && !isFetching) void fetchNextPage({ cancelRefetch: false });
  }, [isLoadingMore, isFetching, fetchNextPage, shown]);
  const showMore = () => {
    // A wish that failed is the same one again.
    setWish({ key, pages: (isError ? shown : Math.max(wanted, shown)) + 1 });
    if (isError) void refetch(); // then the page that is wanted follows
  };
  return { showMore, isLoadingMore };
}
