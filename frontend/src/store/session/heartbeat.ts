/** How often the session is asked whether it answers, so that what lasts 3 s is shown within 4. */
export const HEARTBEAT_MS = 500;
/** A shorter silence is not shown. */
const SHOWN_AFTER_MS = 3000;
/** A page that comes back after so long was asleep, and has not listened. */
const ASLEEP_MS = 10_000;

/**
 * For how long the session has not answered. What came before the last beat has been read by now; of the time
 * since then no more than one beat counts: in a page that is busy for longer, the answer may be there unread.
 */
export class Heartbeat {
  /** Silence up to the last beat. */
  private silentMs = 0;

  constructor(private last: number) {}

  /** Anything came from the session. */
  heard(now: number): void {
    this.silentMs = 0;
    this.last = now;
  }

  /** Call it every `HEARTBEAT_MS` while an answer is awaited; returns the silence that is worth showing, in s. */
  beat(now: number): number {
    const gap = now - this.last > ASLEEP_MS ? HEARTBEAT_MS : Math.max(0, now - this.last);
    const shown = this.silentMs + Math.min(gap, HEARTBEAT_MS);
    this.silentMs += gap;
    this.last = now;
    return shown < SHOWN_AFTER_MS ? 0 : Math.round(shown / 1000);
  }
}
