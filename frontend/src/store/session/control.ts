import { PROTOCOL, type Commands, type Error as ErrorData, type ServerMessage } from '@/generated/messages';

/** The error of a command that the manager refused, or that failed. */
export class CommandError extends Error {
  override readonly name = 'CommandError';
  constructor(
    readonly code: string,
    message: string,
    readonly hint: string,
  ) {
    super(message);
  }
}

/** Returns whether the connection failed, not the command; the banner reports a lost connection already. */
export const isUnconnected = (error: unknown) =>
  error instanceof CommandError && ['not_connected', 'connection_lost'].includes(error.code);

/** Returns whether a command ended because the user pressed *Cancel*: then no error is shown. */
export const isCancelled = (error: unknown) => error instanceof CommandError && error.code === 'cancelled';

interface Waiting {
  resolve: () => void;
  reject: (error: Error) => void;
}

export interface ControlEvents {
  onMessage: (message: ServerMessage) => void;
  /** Called for every message, also for replies. */
  onHeard: () => void;
  onOpen: () => void;
  /** Called when the socket closes without a call of `close()`. */
  onLost: (code: number, reason: string) => void;
}

/** The control socket: it sends commands, matches their replies, and passes events on. */
export class ControlSocket {
  private socket: WebSocket | null = null;
  private readonly waiting = new Map<string, Waiting>();
  private nextId = 1;
  private isClosing = false;

  constructor(
    private readonly url: string,
    private readonly events: ControlEvents,
  ) {}

  open(): void {
    const socket = new WebSocket(this.url, PROTOCOL);
    this.socket = socket;
    socket.onopen = () => this.events.onOpen();
    socket.onmessage = ({ data }) => this.receive(JSON.parse(String(data)) as ServerMessage);
    socket.onclose = ({ code, reason }) => {
      this.failAll(new CommandError('connection_lost', reason || 'The connection was lost.', ''));
      if (!this.isClosing) this.events.onLost(code, reason);
    };
  }

  get isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Returns whether the socket still has unsent data. */
  get isSending(): boolean {
    return (this.socket?.bufferedAmount ?? 0) > 0;
  }

  /** Sends a command. Resolves with its acknowledgement, or rejects with a `CommandError`. */
  send<K extends keyof Commands>(command: K, data: Commands[K]): Promise<void> {
    const { socket } = this;
    if (!socket || socket.readyState !== WebSocket.OPEN) {
      return Promise.reject(new CommandError('not_connected', 'There is no connection to the session.', ''));
    }
    const id = `c${this.nextId++}`;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      socket.send(JSON.stringify({ id, command, data }));
    });
  }

  close(): void {
    this.isClosing = true;
    this.socket?.close(1000);
    this.socket = null;
  }

  private receive(message: ServerMessage): void {
    this.events.onHeard();
    const waiting = this.waiting.get(message.id);
    if (waiting && (message.command === 'ack' || message.command === 'error')) {
      this.waiting.delete(message.id);
      if (message.command === 'ack') return waiting.resolve();
      const { code, message: text, hint } = message.data as ErrorData;
      return waiting.reject(new CommandError(code, text, hint));
    }
    this.events.onMessage(message);
  }

  private failAll(error: CommandError): void {
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject } of waiting) reject(error);
  }
}
