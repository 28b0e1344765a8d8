/** The size of a spark line in its own units; it is stretched to the available space. */
export const SPARK = { width: 60, height: 14, samples: 40 } as const;

/** Returns a value shortened for a block: few digits, or the beginning of a long text. */
export function shortValue(value: unknown): string {
  if (value === null || value === undefined) return '—';
  if (typeof value === 'number' && !Number.isInteger(value)) return String(Number(value.toPrecision(4)));
  const text = typeof value === 'string' ? value : (JSON.stringify(value) ?? String(value));
  const [line = ''] = text.split('\n');
  return line.length > 24 || line !== text ? `${line.slice(0, 23)}…` : line;
}

/** Returns the points of a spark line: the newest sample at the right, the smallest at the bottom. */
export function sparkPoints(samples: readonly number[]): string {
  const shown = samples.slice(-SPARK.samples);
  const [least, most] = [Math.min(...shown), Math.max(...shown)];
  const room = SPARK.height - 2;
  const step = SPARK.width / (SPARK.samples - 1);
  return shown
    .map((value, index) => {
      const x = SPARK.width - (shown.length - 1 - index) * step;
      const share = most > least ? (value - least) / (most - least) : 0.5;
      return `${x.toFixed(1)},${(1 + room * (1 - share)).toFixed(1)}`;
    })
    .join(' ');
}
