import { expect, it } from 'vitest';
import { decoderOf } from './cdr';

const bytes = (...parts: number[]) => new Uint8Array([0, 1, 0, 0, ...parts]);

it('aligns each number to its size, counted behind the header', () => {
  const decode = decoderOf('a/msg/A', 'uint8 small\nuint32 large\nint16 signed\nfloat64 real\n');
  const data = new Uint8Array(4 + 24);
  const view = new DataView(data.buffer, 4);
  data[1] = 1;
  view.setUint8(0, 7);
  view.setUint32(4, 70_000, true);
  view.setInt16(8, -2, true);
  view.setFloat64(16, 0.5, true);
  expect(decode(data)).toEqual({ small: 7, large: 70_000, signed: -2, real: 0.5 });
});

it('reads big-endian messages too', () => {
  const decode = decoderOf('a/msg/A', 'uint16 value\nuint32[] list\n');
  expect(decode(new Uint8Array([0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 9]))).toEqual({
    value: 258,
    list: [9],
  });
});

it('reads texts, lists and nested types, and skips comments and constants', () => {
  const text = `# about it
uint8 ON=1 # a constant
string name  # with a "#" behind it
B[] parts
bool[2] both
${'='.repeat(80)}
MSG: a/B
uint8 x
`;
  const decode = decoderOf('a/msg/A', text);
  const data = bytes(3, 0, 0, 0, 104, 105, 0, 0, 2, 0, 0, 0, 5, 6, 1, 0);
  expect(decode(data)).toEqual({ name: 'hi', parts: [{ x: 5 }, { x: 6 }], both: new Uint8Array([1, 0]) });
});

it('says what is wrong with bytes that are no message', () => {
  const decode = decoderOf('a/msg/A', 'uint32 value\n');
  expect(() => decode(new Uint8Array(2))).toThrow('no header');
  expect(() => decode(bytes(1, 2))).toThrow('ends after');
  expect(() => decoderOf('a/msg/A', 'Unknown value\n')(bytes(1))).toThrow('Unknown is not defined');
  expect(() => decoderOf('a/msg/A', '()=> evil\n')).toThrow('is no field');
});
