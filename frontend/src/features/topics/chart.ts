import uPlot from 'uplot';
import type { Samples } from '@/store/moment/pastTopics';
import { seriesOf } from '@/store/session/topics';
import { commonUnit } from './plotView';

export const HEIGHT_PX = 210;
/**
 * Colours that are distinguishable in both themes and by colour-blind people (Okabe and Ito). Lines are
 * alternately solid and dashed.
 */
const COLORS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];

export const colorOf = (index: number) => COLORS[index % COLORS.length] ?? '#0072b2';

const isDashed = (index: number): boolean => Math.floor(index / COLORS.length) % 2 === 1;

/** Returns the style of a line's mark in the legend. */
export const markOf = (index: number) =>
  isDashed(index)
    ? { background: `repeating-linear-gradient(90deg, ${colorOf(index)} 0 4px, transparent 4px 6px)` }
    : { background: colorOf(index) };

export type Plotted = readonly { readonly topic: string; readonly path: string }[];

/** Returns the samples of a field: times in s, and their values. */
export type SamplesOf = (topic: string, path: string) => Samples;

/** Returns all series over the union of their times, with a gap where a series has no sample. */
export function dataOf(plotted: Plotted, samplesOf: SamplesOf = seriesOf): uPlot.AlignedData {
  const tables = plotted.map(({ topic, path }): uPlot.AlignedData => {
    const { times, values } = samplesOf(topic, path);
    return [[...times], [...values]];
  });
  const [first] = tables;
  if (!first) return [[]];
  return tables.length === 1 ? first : uPlot.join(tables);
}

/** Returns a number of an axis as it is, also a very small one. */
const numberLabel = (value: number): string => String(Number(value.toPrecision(6)));

export function optionsFor(plotted: Plotted, element: HTMLElement, timeLabel: string): uPlot.Options {
  const style = getComputedStyle(element);
  const line = style.getPropertyValue('--bts-border').trim();
  const axis: uPlot.Axis = {
    stroke: style.getPropertyValue('--bts-muted').trim(),
    grid: { stroke: line, width: 1 },
    ticks: { stroke: line, width: 1 },
    font: '11px Inter Variable, system-ui, sans-serif',
    labelFont: '11px Inter Variable, system-ui, sans-serif',
    labelSize: 16,
  };
  const unit = commonUnit(plotted.map(({ path }) => path));
  return {
    width: Math.max(element.clientWidth, 100),
    height: HEIGHT_PX,
    scales: { x: { time: false } },
    legend: { show: false },
    // Drags move the plot instead (`plotGestures`).
    cursor: { drag: { x: false, y: false, setScale: false } },
    axes: [
      { ...axis, label: timeLabel, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
      { ...axis, size: 56, values: (_, ticks) => ticks.map(numberLabel), ...(unit ? { label: unit } : {}) },
    ],
    series: [
      {},
      ...plotted.map(({ topic, path }, index) => ({
        label: `${topic}.${path}`,
        stroke: colorOf(index),
        width: 1.6,
        // Times that only other fields have are no gaps; a null is one.
        spanGaps: false,
        points: { show: false },
        ...(isDashed(index) ? { dash: [6, 4] } : {}),
      })),
    ],
  };
}
