import { jsonLanguage } from '@codemirror/lang-json';
import { Text } from '@codemirror/state';
import type { Diagnostic as Mark } from '@codemirror/lint';
import { useEffect, useState } from 'react';
import { t } from '@/i18n';
import { parseXml, XmlError } from '@/model/document/xml';
import { valueOfYaml } from '@/model/document/yaml';
import { isXml } from './modes';

const READ_AFTER_MS = 300;
/** Longer texts are not parsed at each key, since that would delay typing. */
const LONGEST = 500_000;

/** The place where a text breaks the format of its file type. */
interface TextError {
  readonly offset: number;
  readonly message: string;
}

/** The error of a text, together with that text. */
export interface TextErrors {
  readonly doc: Text;
  readonly errors: readonly TextError[];
}

function jsonErrors(text: string): TextError[] {
  try {
    JSON.parse(text);
    return [];
  } catch {
    // Each browser reports the position in its own way, or not at all.
    let offset: number | null = null;
    jsonLanguage.parser.parse(text).iterate({
      enter: ({ type, from }) => {
        if (type.isError) offset ??= from;
      },
    });
    return [
      { offset: offset ?? text.length, message: t(text.trim() === '' ? 'code:json.empty' : 'code:json.bad') },
    ];
  }
}

function yamlErrors(text: string, doc: Text): TextError[] {
  const read = valueOfYaml(text);
  if (!('problems' in read)) return [];
  return read.problems.map(({ line, column, kind, params }) => ({
    offset: Math.min(doc.line(Math.min(line, doc.lines)).from + column - 1, doc.length),
    message: t(`editor3d:problem.${kind}`, params),
  }));
}

function xmlErrors(text: string): TextError[] {
  try {
    parseXml(text);
    return [];
  } catch (error) {
    if (!(error instanceof XmlError)) throw error;
    return [{ offset: error.offset, message: t(`editor3d:problem.${error.kind}`, error.params) }];
  }
}

/** The syntax error of a JSON, YAML or XML file. */
export function textErrors(path: string, text: string): readonly TextError[] {
  if (text.length > LONGEST) return [];
  if (path.endsWith('.json')) return jsonErrors(text);
  if (/\.ya?ml$/.test(path)) return yamlErrors(text, Text.of(text.split('\n')));
  return isXml(path) ? xmlErrors(text) : [];
}

/** Checks the text shortly after the last change. */
export function useTextErrors(path: string, text: string | null): TextErrors | null {
  const [found, setFound] = useState<TextErrors | null>(null);
  useEffect(() => {
    if (text === null || path.endsWith('.py')) return;
    const timer = setTimeout(() => {
      const plain = text.replace(/\r\n?/g, '\n');
      setFound({ doc: Text.of(plain.split('\n')), errors: textErrors(path, plain) });
    }, READ_AFTER_MS);
    return () => {
      clearTimeout(timer);
    };
  }, [path, text]);
  return found;
}

/** Marks from the error to the end of its word, or of its line. */
export function textMarks(doc: Text, found: TextErrors | null): Mark[] {
  if (!found?.doc.eq(doc)) return [];
  return found.errors.map(({ offset, message }) => {
    const from = Math.min(offset, doc.length);
    const { to, text, from: start } = doc.lineAt(from);
    const word = /^\w+/.exec(text.slice(from - start))?.[0].length ?? 0;
    return { from, to: word > 0 ? from + word : to, severity: 'error', message };
  });
}
