import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import '@/i18n';
import { t } from '@/i18n';
import { isProblem, readScript } from '@/model/script';
import { scriptText } from './scriptText';

type Named = readonly [name: string, from: number, to: number];

interface Case {
  readonly script: string;
  readonly read?: readonly Named[];
  readonly written?: readonly Named[];
  readonly error?: {
    readonly span: readonly [number, number];
    readonly message: string;
    readonly hint: string;
  };
}

const cases = JSON.parse(readFileSync('../tests/shared/scripts.json', 'utf-8')) as readonly Case[];

describe('the editor reads scripts as the engine does', () => {
  it.each(cases.map((each) => [each.script, each] as const))('%s', (script, wanted) => {
    const facts = readScript(script);
    if (isProblem(facts)) {
      expect({ span: facts.span, ...scriptText(facts, t) }).toEqual(wanted.error);
    } else {
      const named = (names: typeof facts.read) => names.map(({ name, span }) => [name, ...span]);
      expect({ script, read: named(facts.read), written: named(facts.written) }).toEqual(wanted);
    }
  });

  it('up to the same length, in characters and not in units of UTF-16', () => {
    const script = (length: number) => `a := '${'𝄞'.repeat(length - 7)}'`;
    expect(isProblem(readScript(script(20000)))).toBe(false);
    const facts = readScript(script(20001));
    expect(isProblem(facts) && { span: facts.span, ...scriptText(facts, t) }).toEqual({
      span: [0, 0],
      message: 'the script is longer than 20000 characters',
      hint: 'split it into several nodes',
    });
  });
});
