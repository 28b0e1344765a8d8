/** Slower pictures than this make 3D useless, 1/s. */
const LEAST_HZ = 5;
/** How long 3D may be that slow, in ms. */
const PATIENCE_MS = 3000;
/** With a longer pause between requests nothing moves: no pictures are expected then. */
const STILL_MS = 600;

/**
 * Judges whether a view draws too slowly. It counts pictures only while they are requested all the time: a
 * paused world needs none. Times are in ms.
 */
export class Slowness {
  private since: number | null = null;
  private requested = -Infinity;
  private pictures = 0;

  /** Notes that a picture is due. */
  request(now: number): void {
    if (now - this.requested > STILL_MS) this.forget();
    this.requested = now;
  }

  /** Notes a picture; counting begins with the first, which also loads textures and compiles shaders. */
  draw(now: number): void {
    if (this.since === null) this.since = now;
    else this.pictures += 1;
  }

  /** Returns the rate of the last `PATIENCE_MS`, 1/s, if it was too low all the time; otherwise null. */
  tooSlow(now: number): number | null {
    if (this.since === null || now - this.since < PATIENCE_MS) return null;
    const hz = (this.pictures * 1000) / (now - this.since);
    this.since = now;
    this.pictures = 0;
    return hz < LEAST_HZ ? hz : null;
  }

  /** Starts again: after a pause, or in a window that was hidden. */
  forget(): void {
    this.since = null;
    this.pictures = 0;
  }
}
