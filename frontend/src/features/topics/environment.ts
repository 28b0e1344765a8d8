/** Lines for a shell; a value that a shell would read otherwise is quoted. */
export function exportLines(environment: Readonly<Record<string, string>>): string {
  return Object.entries(environment)
    .map(([name, value]) => `export ${name}=${/^[\w./:@%+,-]*$/.test(value) ? value : quoted(value)}`)
    .join('\n');
}

const quoted = (value: string) => `'${value.replaceAll("'", String.raw`'\''`)}'`;
