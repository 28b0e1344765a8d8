/** Returns the message of an error: of an exception, or of the language server. */
export function reasonOf(error: unknown): string {
  if (error instanceof Error) return error.message;
  const { message } = (error ?? {}) as { message?: string };
  return message ?? String(error);
}
