import { vi } from 'vitest';
import type { FakeExecutor } from './testing';

interface Asked {
  readonly seq: number;
  readonly command: string;
  readonly arguments: Record<string, unknown>;
}

/** The other end of the Python debugger: answers requests by their command, and sends events. */
export class FakeDebugger {
  private seq = 0;
  private answered = 0;

  constructor(private readonly executor: FakeExecutor) {}

  /** What the page has asked. */
  get asked(): Asked[] {
    return (this.executor.sentAs('dap') as { message: Asked }[]).map(({ message }) => message);
  }

  /** What was asked with a command, each time. */
  askedAs(command: string): Record<string, unknown>[] {
    return this.asked.filter((each) => each.command === command).map((each) => each.arguments);
  }

  /** Waits for the next request that is not answered, and answers it. */
  async answer(command: string, body: unknown = {}, error = ''): Promise<Record<string, unknown>> {
    const next = await vi.waitUntil(() => this.asked[this.answered]);
    if (next.command !== command) throw new Error(`${next.command} was asked, not ${command}`);
    this.answered += 1;
    this.say({ type: 'response', request_seq: next.seq, success: error === '', message: error, body });
    return next.arguments;
  }

  event(event: string, body: unknown = {}): void {
    this.say({ type: 'event', event, body });
  }

  private say(message: Record<string, unknown>): void {
    this.seq += 1;
    this.executor.emit('dap', { message: { seq: this.seq, ...message } });
  }
}

/** A stop in `update` of `actions/Turn.py`, line 12, called by a library. */
export const FRAMES = [
  { id: 7, name: 'update', line: 12, source: { path: 'actions/Turn.py' } },
  { id: 8, name: 'tick', line: 3, source: { path: '/usr/lib/x.py' } },
];
