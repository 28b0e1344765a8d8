import { expect, it } from 'vitest';
import { momentOf } from './address';

it('reads the moment of an address, and nothing else', () => {
  expect(momentOf('?run=0a1b2c3d4e5f&t=12.5')).toEqual({ run: '0a1b2c3d4e5f', t: 12.5 });
  for (const wrong of [
    '',
    '?run=0a1b',
    '?t=3',
    '?run=../x&t=1',
    '?run=0a&t=-1',
    '?run=0a&t=NaN',
    '?run=0a&t=',
  ])
    expect(momentOf(wrong)).toEqual(wrong.endsWith('t=') ? { run: '0a', t: 0 } : null);
});
