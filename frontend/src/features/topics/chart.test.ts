import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { resetTopics, seriesOf } from '@/store/session/topics';
import { colorOf, dataOf, optionsFor } from './chart';

function sample(topic: string, path: string, times: number[], values: (number | null)[]): void {
  Object.assign(seriesOf(topic, path), { times, values });
}

const x = { topic: '/odom', path: 'x' };
const y = { topic: '/scan', path: 'y' };

beforeEach(() => {
  sample('/odom', 'x', [1, 2, 3], [10, 20, 30]);
  sample('/scan', 'y', [2, 4], [5, 6]);
  onTestFinished(resetTopics);
});

describe('dataOf', () => {
  it('has nothing to draw without a field', () => {
    expect(dataOf([])).toEqual([[]]);
  });

  it('is a copy of the samples of one field', () => {
    const [times, values] = dataOf([x]);
    expect([times, values]).toEqual([
      [1, 2, 3],
      [10, 20, 30],
    ]);
    expect(times).not.toBe(seriesOf('/odom', 'x').times);
  });

  it('takes the samples of a recording, and leaves gaps in them', () => {
    const recorded = { times: [0, 1], values: [7, null] };
    expect(dataOf([x], () => recorded)).toEqual([recorded.times, recorded.values]);
    const [, first] = dataOf([x, y], (topic) =>
      topic === '/odom' ? recorded : { times: [0.5], values: [1] },
    );
    // uPlot draws on over undefined, and breaks the line at null.
    expect(first).toEqual([7, undefined, null]);
  });

  it('has all times of several fields, with gaps', () => {
    const [times, first, second] = dataOf([x, y]);
    expect(times).toEqual([1, 2, 3, 4]);
    expect([...(first ?? [])].map((value) => value ?? null)).toEqual([10, 20, 30, null]);
    expect([...(second ?? [])].map((value) => value ?? null)).toEqual([null, 5, null, 6]);
  });
});

describe('optionsFor', () => {
  const host = (width: number) => {
    const element = document.createElement('div');
    Object.defineProperty(element, 'clientWidth', { value: width });
    element.style.setProperty('--bts-border', ' #111 ');
    element.style.setProperty('--bts-muted', ' #222 ');
    return element;
  };

  it('fills the width of its place, and has a width in a hidden one', () => {
    expect(optionsFor([x], host(640), 'Time')).toMatchObject({ width: 640, height: 210 });
    expect(optionsFor([x], host(0), 'Time').width).toBe(100);
  });

  it('has simulated seconds below, in the colours of the theme', () => {
    const { axes, scales, legend, cursor } = optionsFor([x], host(640), 'Time');
    const [time, value] = axes ?? [];
    const words = time?.values as (chart: unknown, ticks: number[]) => string[];
    expect(words(null, [1, 2.5])).toEqual(['1 s', '2.5 s']);
    expect(time).toMatchObject({ stroke: '#222', grid: { stroke: '#111' }, ticks: { stroke: '#111' } });
    expect(value?.size).toBe(56);
    expect([scales?.['x']?.time, legend?.show]).toEqual([false, false]);
    expect(cursor?.drag).toMatchObject({ x: false, y: false });
    expect([time?.label, value?.label]).toEqual(['Time', undefined]);
  });

  it('names the unit that all fields share', () => {
    const speed = { topic: '/odom', path: 'twist.twist.linear.x' };
    expect(optionsFor([speed], host(640), 'Time').axes?.[1]?.label).toBe('m/s');
    expect(optionsFor([speed, x], host(640), 'Time').axes?.[1]?.label).toBeUndefined();
  });

  it('has one line for each field, and the seventh is dashed', () => {
    const many = Array.from({ length: 13 }, (_, index) => ({ topic: '/t', path: `f${index}` }));
    const [, ...lines] = optionsFor(many, host(640), 'Time').series;
    expect(lines.map(({ label }) => label).slice(0, 2)).toEqual(['/t.f0', '/t.f1']);
    expect(lines.map(({ dash }) => dash !== undefined)).toEqual([
      ...Array.from({ length: 6 }, () => false),
      ...Array.from({ length: 6 }, () => true),
      false,
    ]);
    expect(lines.map(({ stroke }) => stroke)).toEqual(many.map((_, index) => colorOf(index)));
    expect(lines.every(({ spanGaps, points }) => spanGaps === false && points?.show === false)).toBe(true);
  });
});

it('has six colours, in turn', () => {
  const colors = Array.from({ length: 6 }, (_, index) => colorOf(index));
  expect(new Set(colors).size).toBe(6);
  expect(colorOf(6)).toBe(colors[0]);
});
