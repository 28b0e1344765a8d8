import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { openSocket, type LanguageSocket } from './socket';

/** A socket whose server is the test. */
class TestSocket {
  static readonly OPEN = 1;
  static last: TestSocket;
  readyState = 1;
  readonly sent: string[] = [];
  closedWith: number | undefined;
  onopen: () => void = () => undefined;
  onmessage: (event: { data: string }) => void = () => undefined;
  onclose: (event: { code: number; reason: string }) => void = () => undefined;
  constructor(readonly url: string) {
    TestSocket.last = this;
  }
  send(text: string): void {
    this.sent.push(text);
  }
  close(code: number): void {
    this.closedWith = code;
  }
}

let transport: LanguageSocket;
const closed = vi.fn();
const waits = vi.fn();
const open = vi.fn((socket: LanguageSocket) => (transport = socket));
const place = (before: number | null, is_own = false) =>
  TestSocket.last.onmessage({ data: JSON.stringify({ method: 'bt/place', params: { before, is_own } }) });

beforeEach(() => {
  closed.mockClear();
  vi.stubGlobal('WebSocket', TestSocket);
  onTestFinished(() => {
    vi.unstubAllGlobals();
  });
  waits.mockClear();
  openSocket('p1', { open, waits, closed });
  place(null);
});

describe('openSocket', () => {
  it('connects to the language server of the project', () => {
    expect(new URL(TestSocket.last.url).pathname).toBe('/ws/projects/p1/language');
  });

  it('begins when it has a place, and says its turn before', () => {
    open.mockClear();
    openSocket('p1', { open, waits, closed });
    place(2);
    place(1, true);
    expect(waits.mock.calls).toEqual([[{ before: 2, is_own: false }], [{ before: 1, is_own: true }]]);
    expect(open).not.toHaveBeenCalled();
    place(null);
    expect(open).toHaveBeenCalledOnce();
  });

  it('passes a text on that only contains such a message', () => {
    const heard: string[] = [];
    transport.subscribe((message) => heard.push(message));
    place(3);
    expect(heard).toHaveLength(1);
    expect(waits).not.toHaveBeenCalled();
  });

  it('sends while it is open', () => {
    transport.send('a');
    TestSocket.last.readyState = 3;
    transport.send('b');
    expect(TestSocket.last.sent).toEqual(['a']);
  });

  it('passes messages on to listeners', () => {
    const heard: string[] = [];
    const listen = (message: string) => heard.push(message);
    transport.subscribe(listen);
    TestSocket.last.onmessage({ data: '{"id":1}' });
    transport.unsubscribe(listen);
    TestSocket.last.onmessage({ data: '{"id":2}' });
    expect(heard).toEqual(['{"id":1}']);
  });

  it('answers an outdated request without an error', () => {
    const heard: unknown[] = [];
    transport.subscribe((message) => heard.push(JSON.parse(message)));
    TestSocket.last.onmessage({ data: '{"jsonrpc":"2.0","id":1,"error":{"code":-32801}}' });
    expect(heard).toEqual([{ jsonrpc: '2.0', id: 1, result: null }]);
  });

  it('closes, and reports why it was closed', () => {
    transport.close();
    expect(TestSocket.last.closedWith).toBe(1000);
    TestSocket.last.onclose({ code: 4408, reason: 'idle' });
    expect(closed).toHaveBeenCalledExactlyOnceWith(4408, 'idle');
  });
});
