import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import type { Segment } from '@/generated/messages';
import { segmentOf } from '../../../harness/runs';
import { Engine, type Ask, type FromEngine } from './engine';

const bytes = () => new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));
const segment = (more: Partial<Segment> = {}) => segmentOf({ to_t: 1, bytes: bytes().length, ...more });

/** Returns the place of the n-th chunk of a file. */
function chunkAt(data: Uint8Array, n: number): number {
  const view = new DataView(data.buffer);
  let at = 8;
  for (let found = 0; ; at += 9 + Number(view.getBigUint64(at + 1, true)))
    if (data[at] === 6 && ++found === n) return at;
}

function engine() {
  const told: FromEngine[] = [];
  const made = new Engine((message) => told.push(message));
  made.receive({ kind: 'begin', run: 'a' });
  const ask = (t: number) => {
    made.receive({ kind: 'ask', id: 1, ask: { what: 'moment', t, tick: null, known: -1 } });
    return (told.at(-1) as Extract<FromEngine, { kind: 'answer' }>).answer as { tick: number } | null;
  };
  return { made, told, ask };
}

it('answers as soon as the part with the moment was read', () => {
  const { made, told, ask } = engine();
  expect(ask(0.5)).toBeNull();
  made.receive({ kind: 'part', segment: segment(), bytes: bytes() });
  expect(told.at(-1)).toMatchObject({ kind: 'overview', overview: { run: 'a', read: [[0, 1]] } });
  expect(ask(0.5)!.tick).toBeGreaterThan(0);
  expect(ask(1.5)).toBeNull();
});

it('answers for the begin of a segment whose time is a little beside that of the recording', () => {
  const { made, ask } = engine();
  made.receive({ kind: 'part', segment: segment({ from_t: 0.1 + 0.2 }), bytes: bytes() });
  expect(ask(0.3)).not.toBeNull();
});

it('answers with topics, their messages at a moment, and numbers', () => {
  const { made, told } = engine();
  const answer = (ask: Ask) => {
    made.receive({ kind: 'ask', id: 1, ask });
    return (told.at(-1) as Extract<FromEngine, { kind: 'answer' }>).answer;
  };
  const fields = [{ topic: '/cmd_vel', path: 'linear.x' }];
  const range = { from: 0, to: 1, most: 100 };
  expect(answer({ what: 'messages', topics: ['/odom'], t: 0.5 })).toBeNull();
  made.receive({ kind: 'part', segment: segment(), bytes: bytes() });
  expect(answer({ what: 'topics' })).toContainEqual(expect.objectContaining({ name: '/odom' }));
  expect(answer({ what: 'messages', topics: ['/odom'], t: 0.5 })).toMatchObject([
    { topic: '/odom', type: 'nav_msgs/msg/Odometry', t: 0.5 },
  ]);
  expect(answer({ what: 'series', fields, range })).toMatchObject({
    isComplete: true,
    fields: [{ lack: null }],
  });
});

it('keeps what came before a damage, and says where it is', () => {
  const { made, told, ask } = engine();
  const damaged = bytes();
  const first = chunkAt(damaged, 2) + 200;
  damaged.fill(0, first, first + 400);
  made.receive({ kind: 'part', segment: segment(), bytes: damaged });
  expect(told.find(({ kind }) => kind === 'failed')).toMatchObject({
    number: 0,
    message: expect.stringMatching(/segment 0, before byte/) as string,
  });
  expect(ask(0)).not.toBeNull();
});

it('forgets a segment that is gone', () => {
  const { made, ask } = engine();
  made.receive({ kind: 'part', segment: segment(), bytes: bytes() });
  made.receive({ kind: 'drop', number: 0 });
  expect(ask(0.5)).toBeNull();
});
