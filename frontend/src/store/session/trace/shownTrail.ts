import { MAX_POINTS, trail, type Trail } from './trail';

/** The numbers of each point of a recorded path: x and y in m, the time in s, and 1 where a path begins. */
export const POINT_NUMBERS = 4;

/** The path that the views draw: that of the present, or until the moment at which the user looks. */
export class ShownTrail {
  /** The recorded path; null: it is not read, or the present is shown. */
  points: Float32Array | null = null;
  /** The last time that is shown, in s; null: the present. */
  until: number | null = null;
  private changes = 0;
  private readonly listeners = new Set<() => void>();

  constructor(private readonly live: Trail) {}

  /** Shows the path until a moment; null: that of the present. Before `points` are read, the page's own is cut. */
  show(until: number | null, points: Float32Array | null): void {
    if (until === this.until && points === this.points) return;
    this.until = until;
    this.points = points;
    this.changes += 1;
    this.listeners.forEach((changed) => changed());
  }

  subscribe(changed: () => void): () => void {
    this.listeners.add(changed);
    return () => this.listeners.delete(changed);
  }

  /** Changes when something else is to be drawn. */
  get version(): string {
    return this.until === null ? `${this.changes}/${this.live.version}` : String(this.changes);
  }

  /** Returns the points to draw, in order: x and y in m, and the time in s. */
  shown(): readonly (readonly [x: number, y: number, t: number])[] {
    const { points, until, live } = this;
    const most = until ?? Infinity;
    const path: [number, number, number][] = [];
    if (points === null) {
      for (let i = 0; i < live.count && live.t(i) <= most; i += 1)
        path.push([live.x(i), live.y(i), live.t(i)]);
      return path;
    }
    for (let at = 0; at < points.length; at += POINT_NUMBERS) {
      const [x = 0, y = 0, t = 0, begins = 0] = points.subarray(at, at + POINT_NUMBERS);
      if (t > most) break;
      if (begins) path.length = 0;
      path.push([x, y, t]);
    }
    return path.slice(-MAX_POINTS);
  }

  /** Returns the time of the point next to a place, the later of two at one place; null if none is near. */
  timeNear(x: number, y: number, withinM: number): number | null {
    let nearest = withinM;
    let time: number | null = null;
    for (const [px, py, t] of this.shown()) {
      const distance = Math.hypot(px - x, py - y);
      if (distance > nearest) continue;
      nearest = distance;
      time = t;
    }
    return time;
  }
}

export const shownTrail = new ShownTrail(trail);
