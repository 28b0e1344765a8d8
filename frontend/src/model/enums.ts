/** The enumerations of a project, `enums.json`; the server checks the file. */

export const ENUMS_FILE = 'enums.json';

/** The text of a new `enums.json`, with an example to change. */
export const NEW_ENUMS = `{
  "format": "bt-studio/enums",
  "version": 1,
  "enums": {
    "Color": { "RED": 0, "GREEN": 1, "BLUE": 2 }
  }
}
`;

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** Returns the names that scripts can use for numbers; none while the text cannot be read. */
export function enumNames(text: string | null): readonly string[] {
  if (text === null) return [];
  let document: unknown;
  try {
    document = JSON.parse(text);
  } catch {
    return [];
  }
  const enums = isRecord(document) ? document['enums'] : null;
  if (!isRecord(enums)) return [];
  const names = Object.values(enums).flatMap((members) => (isRecord(members) ? Object.keys(members) : []));
  return [...new Set(names)];
}
