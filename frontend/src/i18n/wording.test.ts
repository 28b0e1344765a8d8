import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { CODES, type Problem } from '@/model/problems';
import english from './locales/en/editor.json';

interface Rule {
  readonly code: string;
  readonly message: string;
}

const { diagnostics } = JSON.parse(readFileSync('../translator/diagnostics.json', 'utf-8')) as {
  readonly diagnostics: readonly Rule[];
};
/** Returns a text without the names of its values, which differ. */
const wordsOf = (text: string): string => text.replace(/\{+\w+\}+/g, '{}');

const KINDS: readonly Problem['kind'][] = [
  ...([
    'missing-port',
    'missing-key',
    'unknown-port',
    'unclosed-brace',
    'wrong-type',
    'out-of-range',
  ] as const),
  ...(['output-literal', 'empty-key', 'bad-key', 'bad-port-name', 'two-types', 'whole-for-double'] as const),
  ...(['empty-script', 'broken-script', 'missing-tree-port', 'bad-autoremap', 'unknown-type'] as const),
];

it.each(KINDS)('a fault has the same words in the editor and in the terminal: %s', (kind) => {
  const said = diagnostics
    .filter(({ code }) => CODES[kind][0] === code)
    .map(({ message }) => wordsOf(message));
  expect(said).toEqual([wordsOf(english.problem[kind].message)]);
});

it('no text for users names a type of C++', () => {
  // Findings about Python name its types.
  const texts = [
    ...Object.values(english.problem),
    ...diagnostics.filter(({ code }) => code < 'BT06' || code > 'BT07'),
  ];
  expect(
    JSON.stringify(texts.map((each) => Object.values(each))).match(/\b(uint|double|integer)s?\b/gi),
  ).toBeNull();
});
