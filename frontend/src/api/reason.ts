/** Returns the message of the server or of the session together with its hint. */
export function reasonOf(error: Error): string {
  return 'hint' in error && error.hint ? `${error.message} ${String(error.hint)}` : error.message;
}
