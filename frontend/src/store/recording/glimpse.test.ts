import { expect, it } from 'vitest';
import { longRecording } from '../../../harness/recordings';
import { Glimpse } from './glimpse';
import { RunIndex } from './runIndex';
import { indexBegin, SeekIndex } from './seekIndex';
import { SegmentReader } from './segmentReader';
import type { Moment } from './types';

it('shows what the whole recording shows', async () => {
  const file = await longRecording(10);
  const whole = new RunIndex('r');
  const segment = whole.segment(0, 0);
  const reader = new SegmentReader(
    'all',
    (read) => segment.add(read),
    (name, data) => segment.attach(name, data),
  );
  reader.append(file);
  const seek = new SeekIndex(file.subarray(indexBegin(file, file.length)), file.length);
  const plain = (moment: Moment | null) =>
    // Who wrote before the begin is not known.
    moment && { ...moment, entries: moment.entries.map(({ since: _, writer: __, ...entry }) => entry) };
  let shown = 0;
  for (let t = 1.13; t < 9.9; t += 0.37) {
    const pieces = seek.ranges(t, 1)?.map(([offset, length]) => file.slice(offset, offset + length));
    if (!pieces) continue;
    const glimpse = Glimpse.of(whole.beside(), seek, t, pieces)!;
    const [from, to] = glimpse.range;
    for (const each of [t, (from + t) / 2, to]) {
      expect(plain(glimpse.momentAt(each, -1, null))).toEqual(plain(whole.momentAt(each)));
      shown += 1;
    }
    expect(glimpse.momentAt(from - 0.01, -1, null)).toBeNull();
    expect(glimpse.momentAt(to + 0.01, -1, null)).toBeNull();
  }
  expect(shown).toBeGreaterThan(30);
});

it('is none where its bytes do not tell all of the moment', async () => {
  const file = await longRecording(4);
  const seek = new SeekIndex(file.subarray(indexBegin(file, file.length)), file.length);
  expect(Glimpse.of(new RunIndex('r'), seek, 2.5, [])).toBeNull();
});
