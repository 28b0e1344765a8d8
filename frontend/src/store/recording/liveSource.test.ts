import { afterEach, expect, it, vi } from 'vitest';
import type { RecordingPart } from '@/generated/messages';
import * as connection from '@/store/session/connection';
import { frames } from '@/store/session/frames';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { earlierSource, liveSource, runsOf } from './liveSource';

const segment = (run: string, number: number) => segmentOf({ run, number, version: 2, to_t: 20, bytes: 10 });
const part = (more: Partial<RecordingPart> = {}): RecordingPart => ({
  type: 'recording',
  run: 'a',
  branch: 0,
  segment: 1,
  version: 2,
  offset: 5,
  data: new Uint8Array([1]),
  ...more,
});

afterEach(() => useSessionStore.setState(initialSession, true));

it('offers the segments of the last run, and tells when they change', () => {
  const changed = vi.fn();
  const stop = liveSource.subscribe(changed);
  useSessionStore.setState({ segments: [segment('a', 0), segment('b', 0), segment('b', 1)] });
  useSessionStore.setState({ simTime: 3 });
  expect(liveSource.segments().map(({ run, number }) => [run, number])).toEqual([
    ['b', 0],
    ['b', 1],
  ]);
  expect(changed).toHaveBeenCalledTimes(1);
  stop();
});

it('takes the frame that it asked for, and no other', async () => {
  vi.spyOn(connection, 'send').mockResolvedValue(undefined);
  const reading = liveSource.read(segment('a', 1), 5, 10);
  frames.publish(part({ offset: 0, data: new Uint8Array([9]) }));
  frames.publish(part({ version: 1, data: new Uint8Array([9]) }));
  frames.publish(part());
  expect(await reading).toEqual(new Uint8Array([1]));
});

it('fails with the reason of a refused command', async () => {
  vi.spyOn(connection, 'send').mockRejectedValue(new Error('not recorded'));
  await expect(liveSource.read(segment('a', 1), 0, 10)).rejects.toThrow('not recorded');
});

it('offers the segments of an earlier run', () => {
  const segments = [segment('a', 0), segment('a', 1), segment('b', 0)];
  useSessionStore.setState({ segments });
  expect(runsOf(segments)).toEqual(['a', 'b']);
  expect(earlierSource('a').segments()).toEqual(segments.slice(0, 2));
  const changed = vi.fn();
  earlierSource('a').subscribe(changed);
  useSessionStore.setState({ segments: segments.slice(1) });
  expect(changed).toHaveBeenCalledOnce();
});
