/** Returns a name for a job that the session does beside the run. */
export const newJob = (): string =>
  Array.from(crypto.getRandomValues(new Uint8Array(8)), (byte) => byte.toString(16).padStart(2, '0')).join(
    '',
  );

/** Returns what a refusal says, with its hint. */
export function refusalOf(error: unknown): string {
  const message = error instanceof Error ? error.message : String(error);
  const hint = error instanceof Error && 'hint' in error ? String(error.hint) : '';
  return `${message} ${hint}`.trim();
}
