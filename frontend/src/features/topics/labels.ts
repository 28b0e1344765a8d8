const UNITS = ['B/s', 'kB/s', 'MB/s', 'GB/s'];

/**
 * Returns a rate for display. A dash means that the rate is not measured: pictures are measured only while
 * they are echoed.
 */
export function rateLabel(hz: number | null): string {
  return hz === null ? '—' : `${hz >= 10 ? hz.toFixed(0) : hz.toFixed(1)} Hz`;
}

export function bytesLabel(bytesPerSecond: number | null): string {
  if (bytesPerSecond === null) return '—';
  let value = bytesPerSecond;
  let unit = 0;
  while (value >= 1000 && unit < UNITS.length - 1) {
    value /= 1000;
    unit += 1;
  }
  return `${value >= 100 || unit === 0 ? value.toFixed(0) : value.toFixed(1)} ${UNITS[unit]}`;
}

/** Returns a value of a message on one line; numbers have no more digits than needed. */
export function valueLabel(value: unknown): string {
  if (typeof value === 'number')
    return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(7)));
  if (typeof value === 'string') return JSON.stringify(value);
  return String(value);
}
