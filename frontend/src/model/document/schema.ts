import type { ErrorObject } from 'ajv';
import { similarNames } from '../similar';
import { intended, isWanted } from './intended';
import { isObject, type Json, type Path } from './values';

/** A fault of a document; `kind` names a text of `editor3d:problem`, and `params` fill it in. */
export interface Issue {
  readonly path: Path;
  readonly kind: string;
  readonly params: Readonly<Record<string, string | number>>;
}

type Fault = ErrorObject<string, Record<string, unknown>>;

/** The check of a schema, compiled by ajv when the page is built. */
export interface Validator {
  (value: unknown): boolean;
  errors?: readonly Fault[] | null;
}

/** Returns all issues of a value: the first reason for each value, and every wrong key of each object. */
export function checkSchema(value: Json, validate: Validator): Issue[] {
  if (validate(value)) return [];
  const found = (validate.errors ?? []).flatMap((fault) => {
    const issue = issueOf(fault, value);
    return issue ? [{ ...issue, rank: RANKS.indexOf(fault.keyword) }] : [];
  });
  const tooMany = found.filter(({ kind }) => LENGTHS.includes(kind)).map(({ path }) => keyOf(path));
  const seen = new Set<string>();
  return found
    .sort((a, b) => a.rank - b.rank)
    .filter(({ path, kind, params }) => {
      // In a list of the wrong length, issues of the items are meaningless.
      if (tooMany.some((list) => keyOf(path).startsWith(`${list}/`))) return false;
      const key = kind === 'missing' ? `${keyOf(path)} ${params['name'] ?? ''}` : keyOf(path);
      return !seen.has(key) && seen.add(key);
    })
    .map(({ path, kind, params }) => ({ path, kind, params }));
}

/** Keywords of a schema, by rank: a value that fails several is reported for the first of them. */
const RANKS = [
  ...['required', 'additionalProperties', 'const', 'enum', 'discriminator', 'type', 'minItems', 'maxItems'],
  ...['maxLength', 'minLength', 'pattern', 'exclusiveMinimum', 'exclusiveMaximum', 'minimum', 'maximum'],
];
const LENGTHS = ['exactly', 'atLeast', 'atMost'];

const keyOf = (path: Path): string => path.map((step) => `/${step}`).join('');

/** Returns the path of a JSON pointer; steps into lists are numbers. */
function pathOf(pointer: string, value: Json): Path {
  let at: Json | undefined = value;
  return pointer
    .split('/')
    .slice(1)
    .map((part) => {
      const name = part.replace(/~1/g, '/').replace(/~0/g, '~');
      const step = Array.isArray(at) ? Number(name) : name;
      at = Array.isArray(at) ? (at[Number(name)] as Json) : isObject(at) ? at[name] : undefined;
      return step;
    });
}

function issueOf(fault: Fault, value: Json): Issue | null {
  const path = pathOf(fault.instancePath, value);
  const { keyword, params, data, parentSchema: schema = {} } = fault;
  const issue = (kind: string, filled: Issue['params'] = {}): Issue => ({ path, kind, params: filled });
  switch (keyword) {
    case 'required':
      return issue('missing', { name: String(params['missingProperty']) });
    case 'additionalProperties':
      return unknownName(path, String(params['additionalProperty']), schema['properties']);
    case 'const':
      return issue('constant', { expected: String(params['allowedValue']) });
    case 'enum':
      return issue('choice', { choices: listed(params['allowedValues']) });
    case 'discriminator':
      return unknownKind(path, String(params['tag']), params['tagValue'], schema['kinds']);
    case 'type':
      return wrongType(path, String(params['type']), data);
    case 'minItems':
    case 'maxItems':
      return wrongLength(path, keyword, schema);
    case 'maxLength':
      return issue('tooLong', { most: Number(params['limit']) });
    case 'minLength':
      return issue('empty');
    case 'pattern':
      return issue(wordFor(String(params['pattern'])));
    case 'exclusiveMinimum':
      return issue('above', { above: Number(params['limit']) });
    case 'exclusiveMaximum':
      return issue('under', { under: Number(params['limit']) });
    case 'minimum':
    case 'maximum':
      return issue('range', {
        low: schema['minimum'] ?? schema['exclusiveMinimum'] ?? '−∞',
        high: schema['maximum'] ?? Infinity,
      });
    default:
      // `anyOf`: the first of its choices has already reported the reason.
      return null;
  }
}

const listed = (values: unknown): string => (Array.isArray(values) ? values.join(', ') : '');

const wordFor = (pattern: string): string =>
  pattern.startsWith('^#') ? 'color' : pattern.startsWith('^/') ? 'topic' : 'name';

function unknownName(path: Path, name: string, known: unknown): Issue {
  const [near] = similarNames(name, isObject(known) ? Object.keys(known) : [], 1);
  const kind = near ? 'unknownNear' : 'unknown';
  return { path: [...path, name], kind, params: { name, ...(near ? { near } : {}) } };
}

/** Reports an object whose `kind` is missing or unknown. */
function unknownKind(path: Path, key: string, chosen: unknown, kinds: unknown): Issue {
  return chosen === undefined
    ? { path, kind: 'missing', params: { name: key } }
    : { path: [...path, key], kind: 'choice', params: { choices: listed(kinds) } };
}

const TYPES: Readonly<Record<string, string>> = {
  object: 'object',
  array: 'list',
  string: 'text',
  boolean: 'boolean',
  number: 'number',
  integer: 'integer',
};

/**
 * Reports a value of the wrong type. Our schemas use null only as the second choice of an optional value, so
 * null is never reported.
 */
function wrongType(path: Path, type: string, value: unknown): Issue | null {
  if (type === 'null') return null;
  const kind = TYPES[type] ?? 'number';
  const write = isWanted(kind) ? intended(value, kind) : null;
  return write === null ? { path, kind, params: {} } : { path, kind: `${kind}Write`, params: { write } };
}

function wrongLength(path: Path, keyword: string, schema: Readonly<Record<string, unknown>>): Issue {
  const [least, most] = [Number(schema['minItems'] ?? 0), Number(schema['maxItems'] ?? Infinity)];
  if (least === most) return { path, kind: 'exactly', params: { count: least } };
  return keyword === 'minItems'
    ? { path, kind: 'atLeast', params: { least } }
    : { path, kind: 'atMost', params: { most } };
}
