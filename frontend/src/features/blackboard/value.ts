/** A value as people read it: short numbers, JSON for what has parts. */
export function showValue(value: unknown): string {
  if (value === null || value === undefined) return '—';
  if (typeof value === 'number')
    return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
  if (typeof value === 'string') return value;
  return JSON.stringify(value) ?? String(value);
}

/** The typed text as a value, or the expected kind: a name of `blackboard:wrong`. */
export type Read = { readonly value: unknown } | { readonly wrong: 'integer' | 'number' | 'list' | 'dict' };

/**
 * What was typed, as the value that it stands for. A number stays a number and a list a list: the program was
 * written for that. What only the program knows is sent as JSON where it is JSON, else as text.
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

/** Undefined where the text is no JSON. */
function jsonOf(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return undefined;
  }
}
