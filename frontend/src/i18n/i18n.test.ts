import { describe, expect, it } from 'vitest';

type Texts = { [key: string]: string | Texts };

const files = import.meta.glob<Texts>('./locales/*/*.json', { eager: true, import: 'default' });

const PLURAL = /_(one|other|zero|two|few|many)$/;

function keysOf(texts: Texts, prefix = ''): string[] {
  return Object.entries(texts).flatMap(([key, value]) =>
    typeof value === 'string' ? [`${prefix}${key}`.replace(PLURAL, '')] : keysOf(value, `${prefix}${key}.`),
  );
}

function placeholdersOf(texts: Texts, prefix = ''): [string, string][] {
  return Object.entries(texts).flatMap(([key, value]): [string, string][] =>
    typeof value === 'string'
      ? [[`${prefix}${key}`, (value.match(/\{\{\w+\}\}/g) ?? []).sort().join()]]
      : placeholdersOf(value, `${prefix}${key}.`),
  );
}

const english = Object.keys(files).filter((path) => path.includes('/en/'));

describe('texts', () => {
  it.each(english)('%s has the same texts in Spanish', (path) => {
    const spanish = files[path.replace('/en/', '/es/')];
    expect(spanish, 'the file is missing').toBeDefined();
    expect(new Set(keysOf(spanish!))).toEqual(new Set(keysOf(files[path]!)));
  });

  it.each(english)('%s has the same placeholders in Spanish', (path) => {
    const spanish = Object.fromEntries(placeholdersOf(files[path.replace('/en/', '/es/')]!));
    for (const [key, found] of placeholdersOf(files[path]!)) {
      if (!PLURAL.test(key)) expect(spanish[key], key).toBe(found);
    }
  });
});
