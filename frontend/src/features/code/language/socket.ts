import type { Transport } from '@codemirror/lsp-client';
import { socketUrl } from '@/api/http';
import { withoutOutdated } from './answers';

export const CLOSED = { noProject: 4404, idle: 4408, tooMany: 4429, unavailable: 4503 } as const;

export interface LanguageSocket extends Transport {
  close(): void;
}

/**
 * Opens the socket to the project's language server; `on.closed` is called once, with the server's reason.
 */
export function openSocket(
  projectId: string,
  on: { open: (socket: LanguageSocket) => void; closed: (code: number, reason: string) => void },
): { close(): void } {
  const socket = new WebSocket(socketUrl(`/ws/projects/${projectId}/language`));
  const handlers = new Set<(message: string) => void>();
  const transport: LanguageSocket = {
    send: (message) => {
      if (socket.readyState === WebSocket.OPEN) socket.send(message);
    },
    subscribe: (handler) => handlers.add(handler),
    unsubscribe: (handler) => handlers.delete(handler),
    close: () => {
      socket.close(1000);
    },
  };
  socket.onopen = () => {
    on.open(transport);
  };
  socket.onmessage = ({ data }: MessageEvent<string>) => {
    const message = withoutOutdated(data);
    for (const handler of handlers) handler(message);
  };
  socket.onclose = ({ code, reason }) => {
    on.closed(code, reason);
  };
  return transport;
}
