import { readFileSync } from 'node:fs';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Engine } from '@/store/recording/engine';
import { liveSource } from '@/store/recording/liveSource';
import type { EngineLink } from '@/store/recording/recordedRun';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../../harness/runs';
import { setEngineLink } from '../looking';
import { Course } from './course';

const file = new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));

beforeEach(() => {
  vi.spyOn(liveSource, 'read').mockImplementation((_, offset, length) =>
    Promise.resolve(file.slice(offset, offset + length)),
  );
  setEngineLink(() => {
    const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
    const engine = new Engine((message) => queueMicrotask(() => link.onMessage(message)));
    return link;
  });
  const own = { to_t: 1, bytes: file.length };
  useSessionStore.setState({
    segments: [segmentOf({ run: 'a', ...own }), segmentOf({ run: 'last', ...own })],
  });
});
afterEach(() => useSessionStore.setState(initialSession, true));

it('reads what the tree did, and the way of the robot in its part of the course', async () => {
  const course = new Course([{ run: 'a', from: 0.4, to: 0.8 }], () => undefined);
  course.want(0.5);
  expect(course.end()).toBe(1);
  const side = await vi.waitFor(async () => {
    const found = await course.at(0.5);
    expect(found).not.toBeNull();
    return found!;
  });
  expect(side.nodes.map(({ type }) => type)).toContain('SeesLine');
  expect(side.statuses.map(([, status]) => status)).toContain('RUNNING');
  expect(await course.at(0.2)).toBeNull();
  const again = await course.at(0.6);
  expect(again?.nodes).toBe(side.nodes);
  for (const path of await course.paths())
    for (let at = 0; at < path.length; at += 4) expect(path[at + 2]).toBeGreaterThanOrEqual(0.4);
  course.close();
});

it('tells what cannot be read', async () => {
  vi.spyOn(liveSource, 'read').mockImplementation((_, __, length) => Promise.resolve(new Uint8Array(length)));
  const changed = vi.fn<(failure: string) => void>();
  const course = new Course([{ run: 'a', from: 0, to: Infinity }], changed);
  course.want(0.5);
  await vi.waitFor(() => expect(changed.mock.calls.some(([failure]) => failure !== '')).toBe(true));
  course.close();
});
