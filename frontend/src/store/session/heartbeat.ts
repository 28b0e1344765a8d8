/** The period of pings: short enough to report a silence of 3 s within 4 s. */
export const HEARTBEAT_MS = 500;
/** A shorter silence is not shown. */
const SHOWN_AFTER_MS = 3000;
/** A page whose timer stopped for this long was asleep and could not receive. */
const ASLEEP_MS = 10_000;

/**
 * Measures for how long the session has not answered. Between two beats at most one period counts: when the
 * page itself is busy, answers may wait unread.
 */
export class Heartbeat {
  /** The silence up to the last beat. */
  private silentMs = 0;

  constructor(private last: number) {}

  /** Records that a message came from the session. */
  heard(now: number): void {
    this.silentMs = 0;
    this.last = now;
  }

  /** Must be called every `HEARTBEAT_MS` while an answer is awaited; returns the silence to show, in s. */
  beat(now: number): number {
    const gap = now - this.last > ASLEEP_MS ? HEARTBEAT_MS : Math.max(0, now - this.last);
    const shown = this.silentMs + Math.min(gap, HEARTBEAT_MS);
    this.silentMs += gap;
    this.last = now;
    return shown < SHOWN_AFTER_MS ? 0 : Math.round(shown / 1000);
  }
}
