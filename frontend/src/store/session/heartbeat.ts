/** The period of pings: short enough to report a silence of 3 s within 4 s. */
export const HEARTBEAT_MS = 500;
/** The shortest silence that is shown. */
const SHOWN_AFTER_MS = 3000;
/** If the page's timer stopped for this long, the page was suspended and could not receive messages. */
const ASLEEP_MS = 10_000;

/**
 * Measures for how long the session has not answered. Between two beats, at most one period is added: when
 * the page itself is busy, answers may wait unread.
 */
export class Heartbeat {
  /** The measured silence up to the last beat. */
  private silentMs = 0;

  constructor(private last: number) {}

  /** Records that a message came from the session. */
  heard(now: number): void {
    this.silentMs = 0;
    this.last = now;
  }

  /**
   * Updates the silence and returns it in s, or 0 if it is too short to show. Must be called every
   * `HEARTBEAT_MS` while an answer is awaited.
   */
  beat(now: number): number {
    const gap = now - this.last > ASLEEP_MS ? HEARTBEAT_MS : Math.max(0, now - this.last);
    const shown = this.silentMs + Math.min(gap, HEARTBEAT_MS);
    this.silentMs += gap;
    this.last = now;
    return shown < SHOWN_AFTER_MS ? 0 : Math.round(shown / 1000);
  }
}
