/** The part of the time that a plot shows, in s. */
export interface TimeRange {
  readonly min: number;
  readonly max: number;
}

/** Shorter than this nothing can be read. */
const SHORTEST_S = 0.01;

/** Returns the range zoomed by a factor around a time, which stays at its place; below 1 it is closer. */
export function zoomed({ min, max }: TimeRange, at: number, factor: number): TimeRange {
  const by = Math.max(factor, SHORTEST_S / (max - min));
  return { min: at - (at - min) * by, max: at + (max - at) * by };
}

/** Returns the range moved by a time. */
export const moved = ({ min, max }: TimeRange, by: number): TimeRange => ({ min: min + by, max: max + by });

/** Units by the convention of ROS (REP 103), by the last names of a field's path. */
const UNITS: readonly (readonly [RegExp, string])[] = [
  [/(^|\.)linear_acceleration\.[xyz]$/, 'm/s²'],
  [/(^|\.)(angular_velocity|angular)\.[xyz]$/, 'rad/s'],
  [/(^|\.)linear\.[xyz]$/, 'm/s'],
  [/(^|\.)(position|translation|point)\.[xyz]$/, 'm'],
  [/(^|\.)(ranges\[\d+\]|range|range_min|range_max)$/, 'm'],
  [/(^|\.)(angle_min|angle_max|angle_increment|theta|yaw)$/, 'rad'],
  [/(^|\.)(sec|scan_time|time_increment)$/, 's'],
  [/(^|\.)nanosec$/, 'ns'],
  [/(^|\.)voltage$/, 'V'],
  [/(^|\.)current$/, 'A'],
];

/** Returns the unit of a field; empty where it has none, or none is known. */
export const unitOf = (path: string): string => UNITS.find(([pattern]) => pattern.test(path))?.[1] ?? '';

/** Returns the unit that all fields share; empty if they differ. */
export function commonUnit(paths: readonly string[]): string {
  const units = new Set(paths.map(unitOf));
  return units.size === 1 ? ([...units][0] ?? '') : '';
}
