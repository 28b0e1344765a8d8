import type { ServerMessage } from '@/generated/messages';

/** A message of the Debug Adapter Protocol, as the session sends it. */
export interface DapMessage {
  readonly type?: unknown;
  readonly event?: unknown;
  readonly request_seq?: unknown;
  readonly success?: unknown;
  readonly message?: unknown;
  readonly body?: unknown;
}

let listener: ((message: DapMessage) => void) | null = null;

/** Sets who gets the messages of the Python debugger; returns a function that ends it. */
export function listenToDap(next: (message: DapMessage) => void): () => void {
  listener = next;
  return () => {
    if (listener === next) listener = null;
  };
}

/** Passes on a message of the session, if it is one of the Python debugger. */
export function feedDap({ command, data }: ServerMessage): void {
  if (command === 'dap') listener?.((data as { message: DapMessage }).message);
}
