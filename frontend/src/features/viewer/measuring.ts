import { create } from 'zustand';

export type Point = readonly [x: number, y: number, z: number];

interface MeasuringData {
  isOn: boolean;
  /** The measured points in the world frame, in m: none, one or two. */
  points: readonly Point[];
}

export const useMeasuring = create<MeasuringData>(() => ({ isOn: false, points: [] }));

export const setMeasuring = (isOn: boolean) => useMeasuring.setState({ isOn, points: [] });

/** Adds a point to the measurement; a third point starts a new one. */
export function addMeasured(point: Point): void {
  useMeasuring.setState(({ points }) => ({ points: points.length === 2 ? [point] : [...points, point] }));
}

/** Returns the straight distance, the distance along the ground, and the difference in height, in m. */
export function distances([a, b]: readonly [Point, Point]): { straight: number; flat: number; rise: number } {
  const flat = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const rise = b[2] - a[2];
  return { straight: Math.hypot(flat, rise), flat, rise };
}
