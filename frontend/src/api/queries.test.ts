import { QueryClient, QueryObserver } from '@tanstack/react-query';
import { afterEach, expect, it, vi } from 'vitest';
import { fetchAgain } from './queries';

const client = new QueryClient();

afterEach(() => client.clear());

it('does not take a first answer that is from before the change', async () => {
  let answerFirst = (_: string[]): void => undefined;
  const answers = vi
    .fn<() => Promise<string[]>>()
    .mockReturnValueOnce(new Promise((resolve) => (answerFirst = resolve)))
    .mockResolvedValue(['Robotics 1']);
  const list = new QueryObserver(client, { queryKey: ['groups'], queryFn: answers });
  const stop = list.subscribe(() => undefined);
  const again = fetchAgain(client, ['groups']);
  answerFirst([]);
  await again;
  expect(answers).toHaveBeenCalledTimes(2);
  expect(list.getCurrentResult()).toMatchObject({ status: 'success', data: ['Robotics 1'] });
  stop();
});

it('fetches all data below a key, and no other', async () => {
  const fetched: string[] = [];
  const stops = [['runs', 'p1'], ['runs', 'p2'], ['projects']].map((queryKey) =>
    new QueryObserver(client, {
      queryKey,
      queryFn: () => fetched.push(queryKey.join(' ')),
      initialData: 0,
      staleTime: Infinity,
    }).subscribe(() => undefined),
  );
  await fetchAgain(client, ['runs']);
  expect(fetched).toEqual(['runs p1', 'runs p2']);
  for (const stop of stops) stop();
});
