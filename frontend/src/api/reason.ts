/** Returns the message of an error, of the server or of the session together with its hint. */
export function reasonOf(error: unknown): string {
  if (!(error instanceof Error)) return String(error);
  return 'hint' in error && error.hint ? `${error.message} ${String(error.hint)}` : error.message;
}
