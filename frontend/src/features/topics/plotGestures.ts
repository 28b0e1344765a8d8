import type uPlot from 'uplot';
import { moved, zoomed, type TimeRange } from './plotView';

const WHEEL_STEP = 1.2;
/** The share of the range by which an arrow key moves it. */
const ARROW_STEP = 0.2;

/** Samples of less distance, in s, are one. */
const SAME_S = 1e-6;

/** A pointer that moved less is a click. */
const CLICK_PX = 3;

type SetRange = (range: TimeRange | null) => void;

function rangeOf({ scales }: uPlot): TimeRange | null {
  const { min, max } = scales['x'] ?? {};
  return typeof min === 'number' && typeof max === 'number' && max > min ? { min, max } : null;
}

/** Returns the range after a key; undefined for a key without an effect, null for the whole range. */
function rangeAfter(key: string, range: TimeRange): TimeRange | null | undefined {
  const span = range.max - range.min;
  const middle = (range.min + range.max) / 2;
  switch (key) {
    case '+':
    case '=':
      return zoomed(range, middle, 1 / WHEEL_STEP);
    case '-':
      return zoomed(range, middle, WHEEL_STEP);
    case 'ArrowLeft':
      return moved(range, -span * ARROW_STEP);
    case 'ArrowRight':
      return moved(range, span * ARROW_STEP);
    case '0':
      return null;
    default:
      return undefined;
  }
}

/** Returns the sample after (1) or before (-1) a time; at null, the last one. Times are in order. */
export function sampleFrom(
  times: ArrayLike<number>,
  from: number | null,
  direction: 1 | -1,
): number | undefined {
  const all = Array.from(times);
  if (from === null) return all.at(-1);
  return direction > 0
    ? all.find((time) => time > from + SAME_S)
    : all.findLast((time) => time < from - SAME_S);
}

/**
 * Adds the gestures of a plot: the wheel zooms, a drag moves, a double click or 0 shows everything, a click
 * goes to the time under it, and comma and full stop go from sample to sample.
 * Returns a function that removes them.
 *
 * @param shown returns the moment at which one looks; null: the present.
 */
export function gestures(
  chart: uPlot,
  host: HTMLElement,
  setRange: SetRange,
  goTo: (time: number) => void,
  shown: () => number | null,
): () => void {
  const { over } = chart;
  let held: { x: number; range: TimeRange } | null = null;
  const ends = new AbortController();
  const { signal } = ends;

  over.addEventListener(
    'wheel',
    (event) => {
      const range = rangeOf(chart);
      if (!range) return;
      event.preventDefault();
      const at = chart.posToVal(event.clientX - over.getBoundingClientRect().left, 'x');
      setRange(zoomed(range, at, event.deltaY < 0 ? 1 / WHEEL_STEP : WHEEL_STEP));
    },
    { signal, passive: false },
  );
  over.addEventListener(
    'pointerdown',
    (event) => {
      const range = rangeOf(chart);
      if (!range || event.button !== 0) return;
      held = { x: event.clientX, range };
      over.setPointerCapture(event.pointerId);
    },
    { signal },
  );
  over.addEventListener(
    'pointermove',
    (event) => {
      if (!held || event.clientX === held.x) return;
      const { x, range } = held;
      const secondsPerPx = (range.max - range.min) / Math.max(1, over.clientWidth);
      setRange(moved(range, (x - event.clientX) * secondsPerPx));
    },
    { signal },
  );
  over.addEventListener(
    'pointerup',
    ({ clientX }) => {
      if (held && Math.abs(clientX - held.x) <= CLICK_PX)
        goTo(chart.posToVal(clientX - over.getBoundingClientRect().left, 'x'));
    },
    { signal },
  );
  for (const end of ['pointerup', 'pointercancel'] as const) {
    over.addEventListener(end, () => (held = null), { signal });
  }
  over.addEventListener('dblclick', () => setRange(null), { signal });
  host.addEventListener(
    'keydown',
    (event) => {
      const range = rangeOf(chart);
      if (event.key === 'Escape' && held) {
        setRange(held.range);
        held = null;
        return;
      }
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === ',' || event.key === '.') {
        const sample = sampleFrom(chart.data[0], shown(), event.key === '.' ? 1 : -1);
        event.preventDefault();
        event.stopPropagation();
        if (sample !== undefined) goTo(sample);
        return;
      }
      const next = range ? rangeAfter(event.key, range) : undefined;
      if (next === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      setRange(next);
    },
    { signal },
  );
  return () => ends.abort();
}
