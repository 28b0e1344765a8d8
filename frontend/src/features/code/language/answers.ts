/** LSP's codes RequestCancelled and ContentModified: the text has changed since the request. */
const OUTDATED: readonly unknown[] = [-32_800, -32_801];

interface Answer {
  readonly id?: unknown;
  readonly error?: { readonly code?: unknown };
}

/** Removes the error from a response to a request that later typing has made obsolete. */
export function withoutOutdated(message: string): string {
  if (!message.includes('"error"')) return message;
  const answer = JSON.parse(message) as Answer;
  if (!OUTDATED.includes(answer.error?.code)) return message;
  return JSON.stringify({ jsonrpc: '2.0', id: answer.id, result: null });
}
