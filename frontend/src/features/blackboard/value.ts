/** Returns a value for display: numbers with few digits, lists and objects as JSON. */
export function showValue(value: unknown): string {
  if (value === null || value === undefined) return '—';
  if (typeof value === 'number')
    return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
  if (typeof value === 'string') return value;
  return JSON.stringify(value) ?? String(value);
}

/** The result of reading typed text: a value, or the expected kind as a key of `blackboard:wrong`. */
export type Read = { readonly value: unknown } | { readonly wrong: 'integer' | 'number' | 'list' | 'dict' };

/**
 * Converts typed text to a value. The value keeps the type of numbers and lists, since the program expects
 * it. For a type that only the program knows, the value is the parsed JSON if the text is JSON, otherwise the
 * text.
 */
export function readValue(text: string, type: string): Read {
  const json = jsonOf(text);
  switch (type) {
    case 'str':
    case 'string':
      return { value: text };
    case 'bool':
      return { value: text === 'true' };
    case 'list':
    case 'tuple':
      return Array.isArray(json) ? { value: json } : { wrong: 'list' };
    case 'dict':
      return typeof json === 'object' && json !== null && !Array.isArray(json)
        ? { value: json }
        : { wrong: 'dict' };
  }
  if (/^u?int\d*$/.test(type)) return Number.isSafeInteger(json) ? { value: json } : { wrong: 'integer' };
  if (/^(double|float\d*)$/.test(type)) {
    const number = text.trim() === '' ? NaN : Number(text);
    return Number.isFinite(number) ? { value: number } : { wrong: 'number' };
  }
  if (text === '—') return { value: null };
  return { value: json === undefined ? text : json };
}

/** Parses JSON; undefined if the text is not JSON. */
function jsonOf(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return undefined;
  }
}
