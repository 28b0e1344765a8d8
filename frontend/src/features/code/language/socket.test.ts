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

beforeEach(() => {
  closed.mockClear();
  vi.stubGlobal('WebSocket', TestSocket);
  onTestFinished(() => {
    vi.unstubAllGlobals();
  });
  openSocket('p1', { open: (socket) => (transport = socket), closed });
  TestSocket.last.onopen();
});

describe('openSocket', () => {
  it('connects to the language server of the project', () => {
    expect(new URL(TestSocket.last.url).pathname).toBe('/ws/projects/p1/language');
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
