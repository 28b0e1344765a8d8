import { readFileSync } from 'node:fs';
import { SegmentReader } from '@/store/recording/segmentReader';

/** Prints every message of a recording as the page decodes it: topic, time in s, and fields. */
function main(path: string): void {
  const found: [string, number, unknown][] = [];
  const reader = new SegmentReader('file', ({ topic, t, decode }) => found.push([topic, t, decode()]));
  reader.append(new Uint8Array(readFileSync(path)));
  process.stdout.write(JSON.stringify(found, plain));
}

/** Lists of numbers are typed arrays; JSON has no infinite numbers. */
const plain = (_: string, value: unknown): unknown =>
  ArrayBuffer.isView(value) ? Array.from(value as Uint8Array) : value;

main(process.argv[2] ?? '');
