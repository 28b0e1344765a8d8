import { LSPClient, type LSPClientConfig, type Transport } from '@codemirror/lsp-client';
import { onTestFinished } from 'vitest';

interface Message {
  readonly id?: number;
  readonly method: string;
  readonly params: unknown;
}

/** The other end of a connection to a language server: records what it is sent, and answers. */
export class FakeLanguageServer implements Transport {
  readonly received: Message[] = [];
  private handlers: ((message: string) => void)[] = [];

  constructor(private readonly answers: Readonly<Record<string, unknown>> = {}) {}

  send(text: string): void {
    const message = JSON.parse(text) as Message;
    this.received.push(message);
    if (message.id === undefined) return;
    const result =
      message.method === 'initialize'
        ? { capabilities: { textDocumentSync: 2, renameProvider: true } }
        : (this.answers[message.method] ?? null);
    const answer = JSON.stringify({ jsonrpc: '2.0', id: message.id, result });
    queueMicrotask(() => this.handlers.forEach((handler) => handler(answer)));
  }

  subscribe(handler: (message: string) => void): void {
    this.handlers.push(handler);
  }

  unsubscribe(handler: (message: string) => void): void {
    this.handlers = this.handlers.filter((each) => each !== handler);
  }

  /** The parameters of each message of a method. */
  sent(method: string): unknown[] {
    return this.received.filter((message) => message.method === method).map(({ params }) => params);
  }
}

/** A client that is connected to a fake server. */
export async function connectedClient(
  config: LSPClientConfig,
  answers: Readonly<Record<string, unknown>> = {},
) {
  const server = new FakeLanguageServer(answers);
  const client = new LSPClient(config);
  client.connect(server);
  await client.initializing;
  onTestFinished(() => client.disconnect());
  return { client, server };
}
