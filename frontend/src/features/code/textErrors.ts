import { jsonLanguage } from '@codemirror/lang-json';
import { Text } from '@codemirror/state';
import type { Diagnostic as Mark } from '@codemirror/lint';
import { useEffect } from 'react';
import { t } from '@/i18n';
import { parseXml, XmlError } from '@/model/document/xml';
import { valueOfYaml } from '@/model/document/yaml';
import { setTextFindings, type TextError, type TextErrors } from '@/store/problems/texts';
import { isOf } from './findings';
import { isXml } from './modes';

const READ_AFTER_MS = 300;
/**
 * The longest text that is checked while the user types; parsing a longer one at each key would delay typing.
 */
const LONGEST = 500_000;

type Place = Omit<TextError, 'line'>;

function jsonErrors(text: string): Place[] {
  try {
    JSON.parse(text);
    return [];
  } catch {
    // Browsers report the position differently, or not at all, so the parser finds it.
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

function yamlErrors(text: string, doc: Text): Place[] {
  const read = valueOfYaml(text);
  if (!('problems' in read)) return [];
  return read.problems.map(({ line, column, kind, params }) => ({
    offset: Math.min(doc.line(Math.min(line, doc.lines)).from + column - 1, doc.length),
    message: t(`editor3d:problem.${kind}`, params),
  }));
}

function xmlErrors(text: string): Place[] {
  try {
    parseXml(text);
    return [];
  } catch (error) {
    if (!(error instanceof XmlError)) throw error;
    return [{ offset: error.offset, message: t(`editor3d:problem.${error.kind}`, error.params) }];
  }
}

function placesOf(path: string, text: string): Place[] {
  if (path.endsWith('.json')) return jsonErrors(text);
  if (/\.ya?ml$/.test(path)) return yamlErrors(text, Text.of(text.split('\n')));
  return isXml(path) ? xmlErrors(text) : [];
}

/** Returns the syntax errors of a JSON, YAML or XML file. */
export function textErrors(path: string, text: string): readonly TextError[] {
  if (text.length > LONGEST) return [];
  return placesOf(path, text).map(({ offset, message }) => ({
    offset,
    line: text.slice(0, offset).split('\n').length,
    message,
  }));
}

/**
 * Checks a text shortly after the last change. When the editor closes, its findings are removed from the
 * list.
 */
export function useTextErrors(path: string, text: string | null): void {
  useEffect(() => {
    if (text === null || path.endsWith('.py')) return;
    const timer = setTimeout(() => {
      const plain = text.replace(/\r\n?/g, '\n');
      setTextFindings('errors', path, { text: plain, errors: textErrors(path, plain) });
    }, READ_AFTER_MS);
    return () => {
      clearTimeout(timer);
    };
  }, [path, text]);
  useEffect(
    () => () => {
      setTextFindings('errors', path, null);
    },
    [path],
  );
}

/** Returns the marks of syntax errors, each from the error to the end of its word, or of its line. */
export function textMarks(doc: Text, found: TextErrors | undefined): Mark[] {
  if (!found || !isOf(doc, found)) return [];
  return found.errors.map(({ offset, message }) => {
    const from = Math.min(offset, doc.length);
    const { to, text, from: start } = doc.lineAt(from);
    const word = /^\w+/.exec(text.slice(from - start))?.[0].length ?? 0;
    return { from, to: word > 0 ? from + word : to, severity: 'error', message };
  });
}
