import { send } from '@/store/session/connection';
import type { DapMessage } from '@/store/session/dap';

interface Waiting {
  readonly resolve: (body: unknown) => void;
  readonly reject: (error: Error) => void;
}

let seq = 0;
const waiting = new Map<number, Waiting>();

function settle(own: number, finish: (each: Waiting) => void): void {
  const each = waiting.get(own);
  waiting.delete(own);
  if (each) finish(each);
}

/** Sends a request of the Debug Adapter Protocol; resolves with the body of its answer. */
export function request<Body>(command: string, args: Record<string, unknown> = {}): Promise<Body> {
  seq += 1;
  const own = seq;
  const answer = new Promise<Body>((resolve, reject) => {
    waiting.set(own, { resolve: (body) => resolve(body as Body), reject });
  });
  const message = { seq: own, type: 'request', command, arguments: args };
  send('dap', { message }).catch((error: unknown) =>
    settle(own, ({ reject }) => reject(error instanceof Error ? error : new Error(String(error)))),
  );
  return answer;
}

/** Settles the request that a message answers; returns whether it is an answer. */
export function takeAnswer({ type, request_seq, success, message, body }: DapMessage): boolean {
  if (type !== 'response') return false;
  settle(Number(request_seq), ({ resolve, reject }) =>
    success === true ? resolve(body ?? {}) : reject(new Error(String(message ?? ''))),
  );
  return true;
}

/** Ends the wait for all answers, as when the connection is lost. */
export function dropRequests(): void {
  for (const own of [...waiting.keys()]) settle(own, ({ reject }) => reject(new Error('disconnected')));
}
