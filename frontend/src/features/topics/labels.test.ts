import { describe, expect, it } from 'vitest';
import { bytesLabel, rateLabel, valueLabel } from './labels';

describe('rateLabel', () => {
  it.each([
    [null, '—'],
    [0.25, '0.3 Hz'],
    [9.94, '9.9 Hz'],
    [10, '10 Hz'],
    [29.6, '30 Hz'],
  ])('%s: %s', (hz, label) => {
    expect(rateLabel(hz)).toBe(label);
  });
});

describe('bytesLabel', () => {
  it.each([
    [null, '—'],
    [0, '0 B/s'],
    [999, '999 B/s'],
    [1000, '1.0 kB/s'],
    [99_900, '99.9 kB/s'],
    [100_000, '100 kB/s'],
    [2_500_000, '2.5 MB/s'],
    [5e12, '5000 GB/s'],
  ])('%s: %s', (bytes, label) => {
    expect(bytesLabel(bytes)).toBe(label);
  });
});

describe('valueLabel', () => {
  it.each([
    [3, '3'],
    [0.123456789, '0.1234568'],
    ['a "b"', '"a \\"b\\""'],
    [true, 'true'],
    [null, 'null'],
  ])('%s: %s', (value, label) => {
    expect(valueLabel(value)).toBe(label);
  });
});
