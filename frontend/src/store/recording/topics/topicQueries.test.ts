import { expect, it } from 'vitest';
import type { Fields } from '../cdr';
import type { Read } from '../segmentReader';
import { MOST_MESSAGE_BYTES, TopicMessages } from './topicMessages';
import { messagesAt, seriesOf, topicsOf, type TopicPart } from './topicQueries';

type Sent = readonly [t: number, fields: Fields, bytes?: number, topic?: string];

function part(number: number, ...sent: readonly Sent[]): TopicPart {
  const topics = new TopicMessages();
  for (const [t, fields, bytes = 10, topic = '/odom'] of sent)
    topics.add({ topic, type: 'a/msg/A', t, data: new Uint8Array(bytes), decode: () => fields } as Read);
  return { number, until: sent.at(-1)?.[0] ?? 0, topics };
}

const ALL = { from: -Infinity, to: Infinity, most: 1000 };
const x = { topic: '/odom', path: 'x' };

/** Returns times and values of a field, after all was decoded. */
function numbers(parts: readonly TopicPart[], range: Partial<typeof ALL> = {}, field = x) {
  for (;;) {
    const { fields, isComplete } = seriesOf(parts, [field], { ...ALL, ...range });
    const { times, values, lack } = fields[0]!;
    if (isComplete) return { samples: Array.from(times, (t, at) => [t, values[at]]), lack };
  }
}

it('lists topics by name with their mean rate in all parts', () => {
  const parts = [part(0, [0, {}, 10], [1, {}, 30], [1, {}, 5, '/b']), part(1, [2, {}, 20])];
  expect(topicsOf(parts)).toMatchObject([
    { name: '/b', type: 'a/msg/A', hz: null, bytes_per_s: null },
    { name: '/odom', hz: 1, bytes_per_s: 30 },
  ]);
});

it('returns the last message until a moment, from an earlier part, too, and cuts what is long', () => {
  const long = { ranges: new Float32Array(100), text: 'a'.repeat(2000), pose: { x: 1 } };
  const parts = [part(0, [1, long, 99]), part(1, [5, { x: 2 }])];
  const [found] = messagesAt(parts, ['/odom', '/no'], 4);
  expect(found).toMatchObject({ topic: '/odom', t: 1, bytes: 99, cut: { ranges: 100, text: 2000 } });
  expect((found!.message['ranges'] as number[]).length).toBe(64);
  expect(found!.message['pose']).toEqual({ x: 1 });
  expect(messagesAt(parts, ['/odom'], 5)[0]).toMatchObject({ t: 5, message: { x: 2 } });
  expect(messagesAt(parts, ['/odom'], 0.5)).toEqual([]);
});

it('has the numbers of a field; what is no finite number is a gap', () => {
  const parts = [part(0, [0, { x: 1 }], [1, { x: Infinity }], [2, { x: 'a' }], [3, { x: true }])];
  expect(numbers(parts)).toEqual({
    samples: [
      [0, 1],
      [1, NaN],
      [2, NaN],
      [3, 1],
    ],
    lack: null,
  });
});

it('breaks the line where a part between is not read', () => {
  const parts = [part(0, [0, { x: 1 }]), part(1, [1, { x: 2 }]), part(3, [3, { x: 3 }])];
  expect(numbers(parts).samples).toEqual([
    [0, 1],
    [1, 2],
    [1, NaN],
    [3, 3],
  ]);
});

it('has the samples of a range, and those just outside of it', () => {
  const parts = [part(0, ...Array.from({ length: 10 }, (_, t): Sent => [t, { x: t }]))];
  const times = (range: Partial<typeof ALL>) => numbers(parts, range).samples.map(([t]) => t);
  expect(times({ from: 3.5, to: 5 })).toEqual([3, 4, 5, 6]);
  expect(times({ from: 20, to: 30 })).toEqual([9]);
  expect(times({ from: -5, to: -1 })).toEqual([0]);
});

it('keeps the least and the greatest of each stretch where there are too many samples', () => {
  const parts = [
    part(0, ...Array.from({ length: 3000 }, (_, t): Sent => [t, { x: t === 1500 ? 99 : t % 2 }])),
  ];
  const { samples } = numbers(parts, { most: 100 });
  expect(samples.length).toBeLessThanOrEqual(100);
  expect(samples).toContainEqual([1500, 99]);
  expect(samples.map(([t]) => t)).toEqual(samples.map(([t]) => t).toSorted((a, b) => a! - b!));
});

it('says what is lacking: the topic, a number, messages that are too large, or some of many', () => {
  expect(numbers([part(0, [0, { x: 1 }])], {}, { topic: '/no', path: 'x' })).toEqual({
    samples: [],
    lack: 'topic',
  });
  expect(numbers([part(0, [0, { x: 'a' }])]).lack).toBe('field');
  expect(numbers([part(0, [0, { x: 1 }, MOST_MESSAGE_BYTES + 1])])).toEqual({ samples: [], lack: 'size' });
  const thinned = part(0, [0, { x: 1 }], [1, { x: 2 }]);
  thinned.topics.thin();
  expect(numbers([thinned])).toEqual({ samples: [[0, 1]], lack: 'thinned' });
});

it('decodes a long recording in several answers, and reaches its end', () => {
  const parts = [part(0, ...Array.from({ length: 1200 }, (_, t): Sent => [t, { x: t }]))];
  const first = seriesOf(parts, [x], ALL);
  expect(first.isComplete).toBe(false);
  expect(first.fields[0]!.times.length).toBeLessThan(1200);
  expect(numbers(parts, { most: 5000 }).samples.length).toBe(1200);
});
