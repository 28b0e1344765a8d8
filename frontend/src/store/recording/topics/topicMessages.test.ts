import { expect, it } from 'vitest';
import type { Fields } from '../cdr';
import type { Read } from '../segmentReader';
import { MOST_MESSAGE_BYTES, TopicMessages } from './topicMessages';

const read = (t: number, fields: Fields = { x: t }, bytes = 100, more: Partial<Read> = {}): Read => ({
  topic: '/odom',
  type: 'nav_msgs/msg/Odometry',
  t,
  data: new Uint8Array(bytes),
  decode: () => fields,
  ...more,
});

it('keeps the messages of robot and project, and none of the tree', () => {
  const topics = new TopicMessages();
  topics.add(read(1));
  topics.add(read(2, {}, 100, { topic: '/bt/tick', type: 'bt_studio_msgs/msg/Tick' }));
  expect([...topics.topics.keys()]).toEqual(['/odom']);
  expect([topics.last('/odom', 0.9), topics.last('/odom', 1)?.t, topics.last('/no', 1)]).toEqual([
    null,
    1,
    null,
  ]);
});

it('counts a message that is too large, and does not keep it', () => {
  const topics = new TopicMessages();
  topics.add(read(1, {}, MOST_MESSAGE_BYTES + 1));
  expect(topics.topics.get('/odom')).toMatchObject({ count: 1, isTooLarge: true, reads: [] });
  expect(topics.bytes).toBe(0);
});

it('stays in its bound of memory: of the largest topic fewer messages are kept, over all of its time', () => {
  const topics = new TopicMessages(100_000);
  for (let t = 0; t < 2000; t += 1) {
    topics.add(read(t, { x: t }, 1000));
    if (t % 100 === 0) topics.add(read(t, {}, 10, { topic: '/small' }));
    expect(topics.bytes).toBeLessThanOrEqual(100_000);
  }
  const { reads, every, count } = topics.topics.get('/odom')!;
  expect(count).toBe(2000);
  expect(every).toBeGreaterThan(1);
  expect(reads.length).toBeGreaterThan(30);
  expect(reads.map(({ t }) => t)).toEqual(Array.from(reads, (_, at) => at * every));
  expect(topics.topics.get('/small')).toMatchObject({ every: 1, count: 20 });
});

it('decodes each message once, some at a time, and forgets fields that are not asked for any more', () => {
  let decoded = 0;
  const topics = new TopicMessages();
  const add = (t: number) =>
    topics.add(read(t, {}, 9, { decode: () => ((decoded += 1), { x: t, name: 'a', on: true }) }));
  for (const t of [1, 2, 3]) add(t);
  expect(topics.decode('/odom', ['x', 'name'], 2)).toBe(2);
  expect(topics.decode('/odom', ['x', 'name'], 2)).toBe(1);
  expect(topics.decode('/odom', ['x', 'name'], 2)).toBe(0);
  const { values } = topics.topics.get('/odom')!;
  expect([values.get('x'), values.get('name'), decoded]).toEqual([[1, 2, 3], [NaN, NaN, NaN], 3]);
  add(4);
  topics.decode('/odom', ['x', 'on'], 9);
  expect([...values]).toEqual([
    ['x', [1, 2, 3, 4]],
    ['on', [1, 1, 1, 1]],
  ]);
  expect(topics.decode('/no', ['x'], 9)).toBe(0);
});

it('has a gap at a damaged message', () => {
  const topics = new TopicMessages();
  const decode = () => {
    throw new Error('damaged');
  };
  for (const one of [read(1), read(2, {}, 9, { decode }), read(3)]) topics.add(one);
  topics.decode('/odom', ['x'], 9);
  expect(topics.topics.get('/odom')!.values.get('x')).toEqual([1, NaN, 3]);
});
