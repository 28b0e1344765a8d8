/** Returns shell commands that set the variables; values with special characters are quoted. */
export function exportLines(environment: Readonly<Record<string, string>>): string {
  return Object.entries(environment)
    .map(([name, value]) => `export ${name}=${/^[\w./:@%+,-]*$/.test(value) ? value : quoted(value)}`)
    .join('\n');
}

const quoted = (value: string) => `'${value.replaceAll("'", String.raw`'\''`)}'`;
