import { readFileSync } from 'node:fs';
import { afterEach, describe, expect, it } from 'vitest';
import { setLanguage } from '@/i18n';
import spanish from '@/i18n/locales/es/findings.json';
import { CODES } from '@/model/problems';
import { findingText } from './findingText';

interface Rule {
  readonly code: string;
  readonly message: string;
  readonly hint: string;
}

const table = JSON.parse(readFileSync('../translator/diagnostics.json', 'utf-8')) as {
  readonly diagnostics: readonly Rule[];
};
const words = Object.entries(spanish as Record<string, Record<string, string>>);

const placeholders = (text: string, form: RegExp): string[] =>
  [...text.matchAll(form)].map(([, name = '']) => name);

describe('findings of the server in Spanish', () => {
  it('exist for all codes without a text of the editor', () => {
    const own = new Set(Object.values(CODES).flat());
    const needed = table.diagnostics
      .map(({ code }) => code)
      .filter((code) => code < 'BT0800' && (!own.has(code) || code === 'BT0115'));
    expect(words.map(([code]) => code)).toEqual(expect.arrayContaining(needed));
  });

  it.each(words)('%s uses only values that it gets', (code, texts) => {
    const rule = table.diagnostics.find((each) => each.code === code);
    const known = placeholders(`${rule?.message} ${rule?.hint}`, /(?<!\{)\{(\w+)\}/g);
    for (const text of Object.values(texts)) {
      for (const name of placeholders(text, /\{\{(\w+)\}\}/g)) expect([...known, 'near']).toContain(name);
    }
  });

  describe('are shown', () => {
    const unused = {
      code: 'BT0401',
      message: '“speed” is read by the port or script “x”, but nothing in the tree writes it.',
      hint: 'Connect an output to it.',
      values: { key: 'speed', port: 'x', suggestion: '', near: '' },
    };
    afterEach(() => {
      setLanguage('en');
    });

    it('as sent, in English', () => {
      expect(findingText(unused)).toEqual({ message: unused.message, hint: unused.hint });
    });

    it('in the language of the page, with the similar name if there is one', () => {
      setLanguage('es');
      expect(findingText(unused).message).toBe(
        'El puerto o script «x» lee «speed», pero nada en el árbol la escribe.',
      );
      expect(findingText(unused).hint).not.toContain('¿');
      const near = { ...unused, values: { ...unused.values, near: 'spead' } };
      expect(findingText(near).hint).toContain('¿Querías decir spead?');
    });

    it('as sent, if there are no texts, or an older server sends no values', () => {
      setLanguage('es');
      const { values: _values, ...old } = unused;
      expect(findingText(old).message).toBe(unused.message);
      expect(findingText({ ...unused, code: 'BT9999' }).message).toBe(unused.message);
    });

    it('without interpreting text of the user', () => {
      setLanguage('es');
      const odd = { ...unused, values: { ...unused.values, key: '{{port}} $t(frame:more)' } };
      expect(findingText(odd).message).toContain('«{{port}} $t(frame:more)»');
    });
  });
});
