/** What to write for a value that was written as the wrong type; `tree_gardener/intended_values.py` is alike. */

const WANTED = ['boolean', 'number', 'integer', 'text'] as const;
export type Wanted = (typeof WANTED)[number];

export const isWanted = (kind: string): kind is Wanted => (WANTED as readonly string[]).includes(kind);

/** YAML 1.1 reads these as true and false; the core schema of YAML 1.2 reads them as text. */
const TRUE = /^(true|yes|on|y)$/i;
const FALSE = /^(false|no|off|n)$/i;
const NUMBER = /^[-+]?(\.\d+|\d+(\.\d*)?)(e[-+]?\d+)?$/i;
const WHOLE = /^[-+]?\d+$/;

/** Returns what to write for a value so that it has the wanted type, or null if nobody can know. */
export function intended(value: unknown, wanted: Wanted): string | null {
  if (wanted === 'text') {
    return typeof value === 'number' || typeof value === 'boolean' ? JSON.stringify(String(value)) : null;
  }
  if (typeof value !== 'string') return null;
  const word = value.trim();
  if (wanted === 'boolean') return TRUE.test(word) ? 'true' : FALSE.test(word) ? 'false' : null;
  const number = word.replace(/(?<=\d)_+(?=\d)/g, '');
  return (wanted === 'number' ? NUMBER : WHOLE).test(number) ? number : null;
}
