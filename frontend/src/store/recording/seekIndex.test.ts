import { beforeAll, expect, it } from 'vitest';
import { longRecording } from '../../../harness/recordings';
import { indexBegin, SeekIndex, type Range } from './seekIndex';

const SECONDS = 12;
let file: Uint8Array;
let index: SeekIndex;
const bytesOf = (ranges: readonly Range[]) => ranges.reduce((sum, [, length]) => sum + length, 0);

beforeAll(async () => {
  file = await longRecording(SECONDS);
  index = new SeekIndex(file.subarray(indexBegin(file, file.length)), file.length);
});

it('names the bytes from the last begin up to a moment', () => {
  const ranges = index.ranges(8.5, 0)!;
  expect(bytesOf(ranges)).toBeLessThan(file.length / 4);
  // The attached diagram precedes all.
  const [[, length = 0] = [], [from = 0] = [], [to = 0, end = 0] = []] = [
    ranges[0],
    ranges[1],
    ranges.at(-1),
  ];
  expect(from).toBeGreaterThan(file.length / 2);
  expect(length).toBeLessThan(file.length / 100);
  expect(to + end).toBeLessThan(file.length);
});

it('names those from an earlier begin', () => {
  const [now, before] = [index.ranges(8.5, 0)!, index.ranges(8.5, 1)!];
  expect(bytesOf(before)).toBeGreaterThan(bytesOf(now));
});

it('names none where reading from the begin is as fast', () => {
  expect(index.ranges(0.5, 0)).toBeNull();
  expect(index.ranges(8.5, SECONDS)).toBeNull();
});

it('is not made of a file without an index, or one that names bytes after its end', () => {
  expect(() => indexBegin(file.subarray(0, 20), file.length)).toThrow('too short');
  expect(() => indexBegin(new Uint8Array(200), file.length)).toThrow('no index');
  const bytes = file.subarray(indexBegin(file, file.length));
  expect(() => new SeekIndex(bytes, 1000)).toThrow('after its end');
});
