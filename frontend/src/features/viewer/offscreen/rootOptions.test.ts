import { describe, expect, it } from 'vitest';
import { dprRange, rootOptions } from './rootOptions';

describe('the settings of a view', () => {
  it('draw nothing while nobody sees it', () => {
    expect(rootOptions(true, false).frameloop).toBe('demand');
    expect(rootOptions(false, false).frameloop).toBe('never');
  });

  it('spare a processor that draws', () => {
    expect(rootOptions(true, true)).toMatchObject({ shadows: false, gl: { antialias: false } });
    expect(rootOptions(true, false)).toMatchObject({ shadows: 'percentage', gl: { antialias: true } });
    expect(dprRange(true)[1]).toBeLessThan(dprRange(false)[0]);
  });
});
