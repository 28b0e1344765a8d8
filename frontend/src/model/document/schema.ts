import { similarNames } from '../similar';
import { isObject, type Json, type JsonObject, type Path } from './values';

/** A problem of a document; `kind` is a key of `universe:problem`, and `params` fill its text. */
export interface Issue {
  readonly path: Path;
  readonly kind: string;
  readonly params: Readonly<Record<string, string | number>>;
}

type Schema = Readonly<Record<string, unknown>>;

const issue = (path: Path, kind: string, params: Issue['params'] = {}): Issue => ({ path, kind, params });

/** Checks the subset of JSON Schema that our generated schemas use. */
export function checkSchema(value: Json, root: Schema, schema: Schema = root, path: Path = []): Issue[] {
  const reference = schema['$ref'];
  if (typeof reference === 'string') return checkSchema(value, root, definition(root, reference), path);
  if ('const' in schema && value !== schema['const']) {
    return [issue(path, 'constant', { expected: String(schema['const']) })];
  }
  const choices = schema['enum'];
  if (Array.isArray(choices)) {
    if (choices.includes(value)) return [];
    return [issue(path, 'choice', { choices: choices.join(', ') })];
  }
  const kinds = schema['anyOf'];
  if (Array.isArray(kinds)) {
    const tried = (kinds as Schema[]).map((kind) => checkSchema(value, root, kind, path));
    return tried.some((found) => found.length === 0) ? [] : (tried[0] ?? []);
  }
  if (Array.isArray(schema['oneOf'])) return checkChosen(value, root, schema, path);
  switch (schema['type']) {
    case 'null':
      return value === null ? [] : [issue(path, 'number')];
    case 'object':
      return isObject(value) ? checkObject(value, root, schema, path) : [issue(path, 'object')];
    case 'array':
      return Array.isArray(value) ? checkArray(value, root, schema, path) : [issue(path, 'list')];
    case 'string':
      return checkString(value, schema, path);
    case 'boolean':
      return typeof value === 'boolean' ? [] : [issue(path, 'boolean')];
    default:
      return checkNumber(value, schema, path);
  }
}

/** Checks a value of one of several kinds, which a key of the value selects. */
function checkChosen(value: Json, root: Schema, schema: Schema, path: Path): Issue[] {
  if (!isObject(value)) return [issue(path, 'object')];
  const { propertyName = 'kind', mapping = {} } = schema['discriminator'] as {
    propertyName?: string;
    mapping?: Readonly<Record<string, string>>;
  };
  const chosen = value[propertyName];
  if (chosen === undefined) return [issue(path, 'missing', { name: propertyName })];
  const reference =
    typeof chosen === 'string' && Object.hasOwn(mapping, chosen) ? mapping[chosen] : undefined;
  if (reference !== undefined) return checkSchema(value, root, definition(root, reference), path);
  return [issue([...path, propertyName], 'choice', { choices: Object.keys(mapping).join(', ') })];
}

function definition(root: Schema, reference: string): Schema {
  const name = reference.replace('#/$defs/', '');
  return (root['$defs'] as Record<string, Schema>)[name] ?? {};
}

function checkObject(value: JsonObject, root: Schema, schema: Schema, path: Path): Issue[] {
  const known = (schema['properties'] ?? {}) as Record<string, Schema>;
  const others = schema['additionalProperties'];
  const found: Issue[] = [];
  for (const name of (schema['required'] ?? []) as string[]) {
    if (!Object.hasOwn(value, name)) found.push(issue(path, 'missing', { name }));
  }
  for (const [name, part] of Object.entries(value)) {
    const at = [...path, name];
    const own = Object.hasOwn(known, name) ? known[name] : undefined;
    if (own) found.push(...checkSchema(part, root, own, at));
    else if (others && typeof others === 'object') {
      found.push(...checkSchema(part, root, others as Schema, at));
    } else {
      const [near] = similarNames(name, Object.keys(known), 1);
      found.push(issue(at, near ? 'unknownNear' : 'unknown', { name, ...(near ? { near } : {}) }));
    }
  }
  return found;
}

function checkArray(value: readonly Json[], root: Schema, schema: Schema, path: Path): Issue[] {
  const least = (schema['minItems'] as number | undefined) ?? 0;
  const most = (schema['maxItems'] as number | undefined) ?? Infinity;
  if (value.length < least || value.length > most) {
    if (least === most) return [issue(path, 'exactly', { count: least })];
    return [value.length < least ? issue(path, 'atLeast', { least }) : issue(path, 'atMost', { most })];
  }
  const prefix = (schema['prefixItems'] ?? []) as Schema[];
  const items = schema['items'] as Schema | undefined;
  return value.flatMap((part, index) => {
    const own = prefix[index] ?? items;
    return own ? checkSchema(part, root, own, [...path, index]) : [];
  });
}

function checkString(value: Json, schema: Schema, path: Path): Issue[] {
  if (typeof value !== 'string') return [issue(path, 'text')];
  const most = (schema['maxLength'] as number | undefined) ?? Infinity;
  if (value.length > most) return [issue(path, 'tooLong', { most })];
  if (value.length < ((schema['minLength'] as number | undefined) ?? 0)) return [issue(path, 'empty')];
  const pattern = schema['pattern'] as string | undefined;
  if (pattern === undefined || new RegExp(pattern).test(value)) return [];
  if (pattern.startsWith('^#')) return [issue(path, 'color')];
  return [issue(path, pattern.startsWith('^/') ? 'topic' : 'name')];
}

function checkNumber(value: Json, schema: Schema, path: Path): Issue[] {
  if (typeof value !== 'number' || !Number.isFinite(value)) return [issue(path, 'number')];
  if (schema['type'] === 'integer' && !Number.isInteger(value)) return [issue(path, 'integer')];
  const low = schema['minimum'] as number | undefined;
  const above = schema['exclusiveMinimum'] as number | undefined;
  const high = (schema['maximum'] as number | undefined) ?? Infinity;
  if (above !== undefined && value <= above) return [issue(path, 'above', { above })];
  const under = schema['exclusiveMaximum'] as number | undefined;
  if (under !== undefined && value >= under) return [issue(path, 'under', { under })];
  if ((low !== undefined && value < low) || value > high) {
    return [issue(path, 'range', { low: low ?? above ?? '−∞', high })];
  }
  return [];
}
