import { isObject, type Json, type JsonObject } from './values';

/** Words that some version of YAML does not read as strings. */
const WORDS = /^(y|n|yes|no|on|off|true|false|null|nan|inf)$/i;
const PLAIN = /^[A-Za-z_/][\w./-]*$/;

/** Returns a value on one line, in the style of the built-in universes. */
export function inline(value: Json): string {
  if (Array.isArray(value)) return `[${(value as Json[]).map(inline).join(', ')}]`;
  if (isObject(value)) {
    const pairs = Object.entries(value).map(([key, part]) => `${keyText(key)}: ${inline(part)}`);
    return `{${pairs.join(', ')}}`;
  }
  if (typeof value === 'string')
    return PLAIN.test(value) && !WORDS.test(value) ? value : JSON.stringify(value);
  return String(value);
}

export const keyText = (key: string): string => inline(key);

/**
 * Returns a key and its value in a block mapping: mappings and lists on lines of their own, other values
 * after the key.
 */
export function blockPair(key: string, value: Json, indent: string): string {
  const isListOfThings = Array.isArray(value) && value.length > 0 && (value as Json[]).every(isObject);
  if (!isListOfThings) return `${indent}${keyText(key)}: ${inline(value)}`;
  const items = (value as Json[]).map((item) => `${indent}  - ${inline(item)}`);
  return [`${indent}${keyText(key)}:`, ...items].join('\n');
}

/** Returns an item of a block sequence, on one line or with one line for each key. */
export function blockItem(value: Json, indent: string, isLong: boolean): string {
  if (!isLong || !isObject(value)) return `${indent}- ${inline(value)}`;
  return Object.entries(value as JsonObject)
    .map(([key, part], index) => `${indent}${index === 0 ? '- ' : '  '}${keyText(key)}: ${inline(part)}`)
    .join('\n');
}
