/** LSP's RequestCancelled and ContentModified: the text has changed since one asked. */
const OUTDATED: readonly unknown[] = [-32_800, -32_801];

interface Answer {
  readonly id?: unknown;
  readonly error?: { readonly code?: unknown };
}

/** A question that its own typist has outrun has no answer; it is no error for anybody to see. */
export function withoutOutdated(message: string): string {
  if (!message.includes('"error"')) return message;
  const answer = JSON.parse(message) as Answer;
  if (!OUTDATED.includes(answer.error?.code)) return message;
  return JSON.stringify({ jsonrpc: '2.0', id: answer.id, result: null });
}
