import { beforeEach, describe, expect, it, vi } from 'vitest';
import type uPlot from 'uplot';
import { gestures, sampleFrom } from './plotGestures';

const setRange = vi.fn();
const goTo = vi.fn();
let over: HTMLElement;
let host: HTMLElement;
let end: () => void;
let shown: number | null = null;

beforeEach(() => {
  setRange.mockClear();
  over = document.createElement('div');
  host = document.createElement('div');
  host.append(over);
  over.setPointerCapture = vi.fn();
  Object.defineProperty(over, 'clientWidth', { value: 100 });
  const scales = { x: { min: 0, max: 10 } };
  const chart = { over, scales, data: [[1, 2.5, 4]], posToVal: (px: number) => px / 10 };
  shown = null;
  end = gestures(chart as unknown as uPlot, host, setRange, goTo, () => shown);
});

const pointer = (type: string, clientX: number) =>
  over.dispatchEvent(new MouseEvent(type, { clientX, button: 0, bubbles: true }));
const press = (key: string) => host.dispatchEvent(new KeyboardEvent('keydown', { key }));
const last = (): unknown => setRange.mock.lastCall?.[0];

describe('gestures', () => {
  it('zoom by the wheel, around the pointer', () => {
    over.dispatchEvent(new WheelEvent('wheel', { deltaY: -100, clientX: 0 }));
    expect(last()).toEqual({ min: 0, max: 10 / 1.2 });
    over.dispatchEvent(new WheelEvent('wheel', { deltaY: 100, clientX: 100 }));
    expect(last()).toMatchObject({ max: 10 });
  });

  it('move by a drag, until it ends', () => {
    pointer('pointerdown', 50);
    pointer('pointermove', 70);
    expect(last()).toEqual({ min: -2, max: 8 });
    pointer('pointerup', 70);
    pointer('pointermove', 90);
    expect(setRange).toHaveBeenCalledOnce();
  });

  it('go to the time of a click, and not of a drag', () => {
    goTo.mockClear();
    pointer('pointerdown', 50);
    pointer('pointermove', 70);
    pointer('pointerup', 70);
    expect(goTo).not.toHaveBeenCalled();
    pointer('pointerdown', 40);
    pointer('pointerup', 41);
    expect(goTo).toHaveBeenCalledExactlyOnceWith(4.1);
  });

  it('go from sample to sample by comma and full stop, from the last one at the present', () => {
    goTo.mockClear();
    press(',');
    expect(goTo).toHaveBeenLastCalledWith(4);
    shown = 4;
    press(',');
    expect(goTo).toHaveBeenLastCalledWith(2.5);
    press('.');
    expect(goTo).toHaveBeenCalledTimes(2);
    shown = 1;
    press('.');
    expect(goTo).toHaveBeenLastCalledWith(2.5);
  });

  it('cancel a drag with Escape', () => {
    pointer('pointerdown', 50);
    pointer('pointermove', 70);
    press('Escape');
    expect(last()).toEqual({ min: 0, max: 10 });
  });

  it('show everything after a double click', () => {
    over.dispatchEvent(new MouseEvent('dblclick'));
    expect(last()).toBeNull();
  });

  it.each([
    ['+', { min: 5 - 5 / 1.2, max: 5 + 5 / 1.2 }],
    ['-', { min: -1, max: 11 }],
    ['ArrowLeft', { min: -2, max: 8 }],
    ['ArrowRight', { min: 2, max: 12 }],
    ['0', null],
  ])('follow the key %s', (key, range) => {
    press(key);
    if (range) expect(last()).toEqual({ min: expect.closeTo(range.min), max: expect.closeTo(range.max) });
    else expect(last()).toBeNull();
  });

  it('leave other keys alone, and end', () => {
    press('a');
    end();
    press('0');
    expect(setRange).not.toHaveBeenCalled();
  });
});

describe('sampleFrom', () => {
  it('is the next sample in a direction, or none', () => {
    expect(sampleFrom([1, 2.5, 4], 2.5, 1)).toBe(4);
    expect(sampleFrom([1, 2.5, 4], 2.4, 1)).toBe(2.5);
    expect(sampleFrom([1, 2.5, 4], 1, -1)).toBeUndefined();
    expect(sampleFrom([], null, 1)).toBeUndefined();
  });
});
