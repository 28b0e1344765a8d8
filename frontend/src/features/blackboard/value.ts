/** A value as people read it: short numbers, JSON for what has parts. */
export function showValue(value: unknown): string {
  if (value === null || value === undefined) return '—';
  if (typeof value === 'number')
    return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
  if (typeof value === 'string') return value;
  return JSON.stringify(value) ?? String(value);
}

/** What was typed, as the value that it stands for: JSON where it is JSON, else text. */
export function readValue(text: string, type: string): unknown {
  if (text === '—') return null;
  if (type === 'str' || type === 'string') return text;
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}
