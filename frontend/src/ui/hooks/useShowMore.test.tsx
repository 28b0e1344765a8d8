import { useInfiniteQuery } from '@tanstack/react-query';
import { act, renderHook, screen, waitFor } from '@testing-library/react';
import { useState } from 'react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { fetchAgain, queries } from '@/api/queries';
import { show, user } from '../../../harness/testing';
import { useShowMore } from './useShowMore';

/** A server with four pages; it answers each request when the test lets it. */
function pages() {
  const asked: number[] = [];
  let waiting: { readonly page: number; done: (page: number) => void; fail: () => void }[] = [];
  const next = async () => {
    await waitFor(() => expect(waiting.length).toBeGreaterThan(0));
    const [first] = waiting.splice(0, 1);
    return first!;
  };
  const fetchPage = (page: number, signal: AbortSignal) =>
    new Promise<number>((done, failed) => {
      asked.push(page);
      const item = { page, done, fail: () => failed(new Error('Not now.')) };
      waiting.push(item);
      signal.addEventListener('abort', () => (waiting = waiting.filter((each) => each !== item)));
    });
  const answer = async () => {
    const { page, done } = await next();
    await act(async () => done(page));
  };
  const fail = async () => {
    const item = await next();
    await act(async () => item.fail());
  };
  return { asked, fetchPage, answer, fail };
}

async function open() {
  const server = pages();
  function List() {
    const [key, setKey] = useState('a');
    const found = useInfiniteQuery({
      queryKey: ['list', key],
      queryFn: ({ pageParam, signal }) => server.fetchPage(pageParam, signal),
      initialPageParam: 1,
      getNextPageParam: (last) => (last < 4 ? last + 1 : undefined),
      retry: false,
    });
    const { showMore, isLoadingMore } = useShowMore(found, key);
    return (
      <>
        <p>{`${key}: ${found.data?.pages.join(' ') ?? ''}`}</p>
        <button onClick={showMore} aria-busy={isLoadingMore}>
          more
        </button>
        <button onClick={() => setKey('b')}>other</button>
      </>
    );
  }
  onTestFinished(() => queries.clear());
  show(<List />);
  await server.answer();
  await screen.findByText('a: 1');
  return server;
}

const more = () => user.click(screen.getByRole('button', { name: 'more' }));
const again = () => act(async () => void fetchAgain(queries, ['list']));

it('loads the wanted page although the list is fetched again meanwhile', async () => {
  const { answer, asked } = await open();
  await more();
  await waitFor(() => expect(asked).toEqual([1, 2]));
  await again();
  await answer();
  await answer();
  expect(await screen.findByText('a: 1 2')).toBeInTheDocument();
  expect(asked).toEqual([1, 2, 1, 2]);
  expect(screen.getByRole('button', { name: 'more' })).toHaveAttribute('aria-busy', 'false');
});

it('loads a page for each click, also for one while a page or the list is loaded', async () => {
  const { answer, asked } = await open();
  await again();
  await more();
  await more();
  for (let count = 0; count < 3; count += 1) await answer();
  expect(await screen.findByText('a: 1 2 3')).toBeInTheDocument();
  expect(asked).toEqual([1, 1, 2, 3]);
});

it('does not try a failed page again by itself, but for the next click', async () => {
  const { answer, fail, asked } = await open();
  await more();
  await fail();
  await waitFor(() =>
    expect(screen.getByRole('button', { name: 'more' })).toHaveAttribute('aria-busy', 'false'),
  );
  expect(asked).toEqual([1, 2]);
  await more();
  for (let count = 0; count < 2; count += 1) await answer();
  expect(await screen.findByText('a: 1 2')).toBeInTheDocument();
  expect(asked).toEqual([1, 2, 1, 2]);
  expect(screen.getByRole('button', { name: 'more' })).toHaveAttribute('aria-busy', 'false');
});

it('does not take a wish to another list', async () => {
  const { answer, asked } = await open();
  await more();
  await answer();
  await screen.findByText('a: 1 2');
  await user.click(screen.getByRole('button', { name: 'other' }));
  await answer();
  expect(await screen.findByText('b: 1')).toBeInTheDocument();
  expect(asked).toEqual([1, 2, 1]);
});

it('does not count the pages of the list before, which are shown meanwhile', () => {
  const found = {
    hasNextPage: true,
    isFetching: true,
    isError: false,
    isPlaceholderData: true,
    fetchNextPage: vi.fn(),
    refetch: vi.fn(),
  };
  const { result, rerender } = renderHook((props) => useShowMore({ ...found, ...props }, 'b'), {
    initialProps: { data: { pages: [1, 2, 3] } },
  });
  act(() => result.current.showMore());
  rerender({ data: { pages: [1] }, isPlaceholderData: false, isFetching: false } as never);
  expect(found.fetchNextPage).not.toHaveBeenCalled();
  expect(result.current.isLoadingMore).toBe(false);
});
