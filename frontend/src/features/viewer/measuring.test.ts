import { afterEach, describe, expect, it } from 'vitest';
import { addMeasured, distances, setMeasuring, useMeasuring } from './measuring';

afterEach(() => setMeasuring(false));

describe('measuring', () => {
  it('is off at first', () => {
    expect(useMeasuring.getState()).toEqual({ isOn: false, points: [] });
  });

  it('has two points at most; a third starts again', () => {
    setMeasuring(true);
    expect(useMeasuring.getState()).toEqual({ isOn: true, points: [] });
    addMeasured([0, 0, 0]);
    addMeasured([1, 0, 0]);
    expect(useMeasuring.getState().points).toHaveLength(2);
    addMeasured([2, 0, 0]);
    expect(useMeasuring.getState().points).toEqual([[2, 0, 0]]);
  });

  it('clears its points when it starts or ends', () => {
    addMeasured([0, 0, 0]);
    setMeasuring(false);
    expect(useMeasuring.getState()).toEqual({ isOn: false, points: [] });
  });

  it.each([
    [[1, 1, 1], [4, 5, 13], { straight: 13, flat: 5, rise: 12 }],
    [[0, 0, 2], [0, 3, 2], { straight: 3, flat: 3, rise: 0 }],
    [[0, 0, 2], [0, 0, 0], { straight: 2, flat: 0, rise: -2 }],
  ] as const)('from %o to %o', (a, b, found) => {
    expect(distances([a, b])).toEqual(found);
  });
});
