import { describe, expect, it } from 'vitest';
import { CONNECTION_EVENTS, CONNECTIONS, nextConnection } from './connectionStates';

describe('the states of the connection', () => {
  it('are reached by these transitions and no others', () => {
    const table = CONNECTIONS.map((from) => [
      from,
      ...CONNECTION_EVENTS.map((event) => nextConnection(from, event)),
    ]);
    expect(table).toEqual([
      // from, then the new state after: start, introduced, closed, ended, leave
      ['off', 'starting', 'open', null, null, 'off'],
      ['starting', 'starting', 'open', 'reconnecting', 'lost', 'off'],
      ['open', 'starting', 'open', 'reconnecting', 'lost', 'off'],
      ['reconnecting', 'starting', 'open', 'reconnecting', 'lost', 'off'],
      ['lost', 'starting', null, null, null, 'off'],
    ]);
  });
});
