import type { Transport } from '@codemirror/lsp-client';
import { socketUrl } from '@/api/http';
import { withoutOutdated } from './answers';

export const CLOSED = { noProject: 4404, idle: 4408, tooMany: 4429, unavailable: 4503 } as const;

export interface LanguageSocket extends Transport {
  close(): void;
}

/** The turn of a page that waits for a place of a language server. */
export interface Turn {
  /** The number of editors that get a place before it; null if it has one. */
  readonly before: number | null;
  /** Whether it waits until another editor of the same user ends. */
  readonly is_own: boolean;
}

/** Returns the turn that the server tells; null for any other message. */
function turnOf(data: string): Turn | null {
  if (!data.includes('"bt/place"')) return null;
  const message = JSON.parse(data) as { readonly method?: string; readonly params?: Turn };
  return message.method === 'bt/place' ? (message.params ?? null) : null;
}

interface SocketEvents {
  /** Called when the page has a place. */
  readonly open: (socket: LanguageSocket) => void;
  /** Called while it waits for one. */
  readonly waits: (turn: Turn) => void;
  /** Called once, with the server's reason. */
  readonly closed: (code: number, reason: string) => void;
}

/** Opens the socket to the project's language server. */
export function openSocket(projectId: string, on: SocketEvents): { close(): void } {
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
  let hasPlace = false;
  socket.onmessage = ({ data }: MessageEvent<string>) => {
    const turn = hasPlace ? null : turnOf(data);
    if (turn) {
      hasPlace = turn.before === null;
      return hasPlace ? on.open(transport) : on.waits(turn);
    }
    const message = withoutOutdated(data);
    for (const handler of handlers) handler(message);
  };
  socket.onclose = ({ code, reason }) => {
    on.closed(code, reason);
  };
  return transport;
}
