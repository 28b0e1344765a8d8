import { frames } from '../frames';
import { currentPoses } from '../poses';

export const MAX_POINTS = 6000;
const STEP_M = 0.03;
const FASTEST_M_S = 5;

/** The path of the first robot: x and y in m, in the world frame. It is recorded whichever view is open. */
export class Trail {
  readonly points = new Float32Array(MAX_POINTS * 2);
  /** The simulated time of each point, in s. */
  readonly times = new Float32Array(MAX_POINTS);
  count = 0;
  /** The simulated time of the last point, in s. */
  time = 0;
  /** Increases when the points change. */
  version = 0;

  add(x: number, y: number, t: number): void {
    const step = Math.hypot(x - this.x(this.count - 1), y - this.y(this.count - 1));
    const passed = t - this.time;
    // Time went back, or the robot was moved by hand: the old path is not connected to the new place.
    if (passed < 0 || (this.count > 0 && step > Math.max(STEP_M, passed * FASTEST_M_S))) this.count = 0;
    else if (this.count > 0 && step < STEP_M) return;
    this.time = t;
    if (this.count === MAX_POINTS) {
      this.points.copyWithin(0, MAX_POINTS, MAX_POINTS * 2);
      this.times.copyWithin(0, MAX_POINTS / 2, MAX_POINTS);
      this.count = MAX_POINTS / 2;
    }
    this.points[this.count * 2] = x;
    this.points[this.count * 2 + 1] = y;
    this.times[this.count] = t;
    this.count += 1;
    this.version += 1;
  }

  x(index: number): number {
    return this.points[index * 2] ?? 0;
  }

  y(index: number): number {
    return this.points[index * 2 + 1] ?? 0;
  }

  t(index: number): number {
    return this.times[index] ?? 0;
  }

  clear(): void {
    this.count = 0;
    this.time = 0;
    this.version += 1;
  }

  keep(): string {
    const points = Array.from(this.points.subarray(0, this.count * 2), (v) => Math.round(v * 1000) / 1000);
    const times = Array.from(this.times.subarray(0, this.count), (v) => Math.round(v * 1000) / 1000);
    return JSON.stringify({ time: this.time, points, times });
  }

  restore(text: string | null): void {
    if (!text) return;
    try {
      const { time, points, times } = JSON.parse(text) as Record<'points' | 'times', number[]> & {
        time: number;
      };
      this.times.set(times.slice(0, MAX_POINTS));
      this.points.set(points.slice(0, MAX_POINTS * 2));
      this.count = Math.min(points.length >> 1, MAX_POINTS);
      this.time = time;
      this.version += 1;
    } catch {
      // An unreadable stored trail is dropped.
    }
  }
}

export const trail = new Trail();

let robotId: number | null = null;

frames.listen('scene', (scene) => {
  robotId = scene.objects.find((object) => object.kind === 'robot')?.id ?? null;
  if (scene.t < trail.time) trail.clear();
});

frames.listen('poses', ({ t }) => {
  const pose = robotId === null ? undefined : currentPoses.get(robotId);
  if (pose) trail.add(pose[0] ?? 0, pose[1] ?? 0, t);
});
