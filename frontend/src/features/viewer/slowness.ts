/** The rate in Hz below which 3D is useless. */
const LEAST_HZ = 5;
/** The time in ms for which 3D may be that slow. */
const PATIENCE_MS = 3000;
/**
 * The pause in ms between requests after which the world counts as still, so that no pictures are expected.
 */
const STILL_MS = 600;

/**
 * Judges whether a view draws too slowly. It counts pictures only while they are requested continuously,
 * since a paused world needs none. Times are in ms.
 */
export class Slowness {
  private since: number | null = null;
  private requested = -Infinity;
  private pictures = 0;

  /** Records that a picture is due. */
  request(now: number): void {
    if (now - this.requested > STILL_MS) this.forget();
    this.requested = now;
  }

  /**
   * Records a picture. Counting begins with the first one, since that also loads textures and compiles
   * shaders.
   */
  draw(now: number): void {
    if (this.since === null) this.since = now;
    else this.pictures += 1;
  }

  /** Returns the rate in Hz over the last `PATIENCE_MS` if it was too low all the time; otherwise null. */
  tooSlow(now: number): number | null {
    if (this.since === null || now - this.since < PATIENCE_MS) return null;
    const hz = (this.pictures * 1000) / (now - this.since);
    this.since = now;
    this.pictures = 0;
    return hz < LEAST_HZ ? hz : null;
  }

  /** Starts counting again, after a pause or in a window that was hidden. */
  forget(): void {
    this.since = null;
    this.pictures = 0;
  }
}
