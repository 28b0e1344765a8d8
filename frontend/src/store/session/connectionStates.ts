/** The states of the page's connection to its session. */
export const CONNECTIONS = ['off', 'starting', 'open', 'reconnecting', 'lost'] as const;
export type Connection = (typeof CONNECTIONS)[number];

/** `introduced`: the manager has sent its first message; `ended`: the session no longer exists on the server. */
export const CONNECTION_EVENTS = ['start', 'introduced', 'closed', 'ended', 'leave'] as const;
export type ConnectionEvent = (typeof CONNECTION_EVENTS)[number];

/**
 * All transitions. An event without an entry is ignored: for example, the answer to a retry may arrive after
 * the user has left the project or the session.
 */
const TRANSITIONS: Readonly<Record<Connection, Partial<Record<ConnectionEvent, Connection>>>> = {
  // After a reload, the page joins a running session without `start`.
  off: { start: 'starting', introduced: 'open', leave: 'off' },
  starting: { start: 'starting', introduced: 'open', closed: 'reconnecting', ended: 'lost', leave: 'off' },
  open: { start: 'starting', introduced: 'open', closed: 'reconnecting', ended: 'lost', leave: 'off' },
  reconnecting: {
    start: 'starting',
    introduced: 'open',
    closed: 'reconnecting',
    ended: 'lost',
    leave: 'off',
  },
  lost: { start: 'starting', leave: 'off' },
};

export const nextConnection = (from: Connection, event: ConnectionEvent): Connection | null =>
  TRANSITIONS[from][event] ?? null;
