import { isMap, isSeq, parseDocument } from 'yaml';
import type { Draft, Result } from './fromStory';

/** The user's choices for a draft. */
export interface Chosen {
  readonly name: string;
  readonly root: boolean;
  readonly statuses: boolean;
  readonly idle: boolean;
  /** The entries of the blackboard whose values are expected. */
  readonly keys: readonly string[];
}

const HEAD = 'format: bt-studio/test\nversion: 1\ntests:\n';

/** Words that YAML reads as something else than text. */
const RESERVED = /^(true|false|null|yes|no|on|off|y|n)$/i;

function textOf(value: string): string {
  return /^[A-Za-z_][\w ]*\w$|^[A-Za-z_]$/.test(value) && !RESERVED.test(value)
    ? value
    : JSON.stringify(value);
}

/** Returns a value in YAML's flow form, which readers of YAML 1.1 and 1.2 understand alike. */
export function flow(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(flow).join(', ')}]`;
  if (typeof value === 'object' && value !== null)
    return `{${Object.entries(value)
      .map(([key, each]) => `${textOf(key)}: ${flow(each)}`)
      .join(', ')}}`;
  if (typeof value === 'string') return textOf(value);
  // YAML 1.1 reads 1e-7 as text.
  return JSON.stringify(value).replace(/^(-?\d+)e/, '$1.0e');
}

/** Returns the lines of a test, without indentation. */
export function linesOf(draft: Draft, chosen: Chosen): string[] {
  const { tree, tickHz, ticks, repeat, blackboard, doubles } = draft;
  return [
    `name: ${flow(chosen.name)}`,
    `tree: ${flow(tree)}`,
    ...(Object.keys(blackboard).length > 0 ? [`blackboard: ${flow(blackboard)}`] : []),
    ...(doubles.length > 0
      ? ['doubles:', ...doubles.flatMap(([node, results]) => doubleLines(node, results))]
      : []),
    `tick_hz: ${flow(tickHz)}`,
    `ticks: ${ticks}`,
    ...(repeat ? ['repeat: true'] : []),
    'expect:',
    ...expectations(draft, chosen).map((each) => `  - ${flow({ at: 'end', ...each })}`),
  ];
}

function doubleLines(node: string, results: readonly Result[] | 'real'): string[] {
  if (results === 'real') return [`  ${textOf(node)}: real`];
  const [first, ...others] = results;
  if (first && others.length === 0 && Object.keys(first.outputs).length === 0)
    return [`  ${textOf(node)}: ${first.status}`];
  return [
    `  ${textOf(node)}:`,
    ...results.map(({ outputs, ...result }) => {
      const all = Object.keys(outputs).length > 0 ? { ...result, outputs } : result;
      return `    - ${flow(all)}`;
    }),
  ];
}

/** Returns the expectations of a test at its end. */
export function expectations(draft: Draft, { root, statuses, idle, keys }: Chosen): object[] {
  const values = Object.fromEntries(
    keys.filter((key) => key in draft.values).map((key) => [key, draft.values[key]]),
  );
  return [
    ...(root && draft.root !== null ? [{ root: draft.root }] : []),
    ...(statuses ? draft.statuses.map(([node, status]) => ({ node, status })) : []),
    ...(statuses ? draft.results.map(([node, result]) => ({ node, result })) : []),
    ...(idle ? draft.idle.map((node) => ({ node, status: 'IDLE' })) : []),
    ...(Object.keys(values).length > 0 ? [{ blackboard: values }] : []),
  ];
}

/** Returns the names of the tests in a file; null if it cannot take one more. */
export function namesIn(text: string): string[] | null {
  const read = parseDocument(text);
  const tests = read.errors.length === 0 && isMap(read.contents) ? read.get('tests') : null;
  if (!isSeq(tests) || tests.flow || tests.items.length === 0) return null;
  return tests.items.flatMap((item) => {
    const name = isMap(item) ? item.get('name') : null;
    return typeof name === 'string' ? [name] : [];
  });
}

/** Returns a file with one more test at its end, or a new file; its other lines stay as they are. */
export function withTest(text: string | null, lines: readonly string[]): { text: string; line: number } {
  if (text === null || text.trim() === '') return { text: `${HEAD}${itemOf(lines, '  ')}`, line: 4 };
  const read = parseDocument(text);
  const tests = isMap(read.contents) ? read.get('tests') : null;
  if (!isSeq(tests) || !tests.range) throw new Error('The file has no list of tests.');
  const first = text.slice(0, tests.range[0]).split('\n').at(-1) ?? '';
  const head = text.slice(0, tests.range[1]).trimEnd();
  const rest = text.slice(tests.range[1]).trimStart();
  return {
    text: `${head}\n\n${itemOf(lines, first)}${rest === '' ? '' : `\n${rest}`}`,
    line: head.split('\n').length + 2,
  };
}

const itemOf = (lines: readonly string[], indent: string): string =>
  lines.map((line, index) => `${indent}${index === 0 ? '- ' : '  '}${line}\n`).join('');
