/** The range of time that a plot shows, in s. */
export interface TimeRange {
  readonly min: number;
  readonly max: number;
}

/** The shortest range in s that can be read. */
const SHORTEST_S = 0.01;

/** Returns a range zoomed about a time, which keeps its place; a factor below 1 zooms in. */
export function zoomed({ min, max }: TimeRange, at: number, factor: number): TimeRange {
  const by = Math.max(factor, SHORTEST_S / (max - min));
  return { min: at - (at - min) * by, max: at + (max - at) * by };
}

/** Returns a range moved by a time. */
export const moved = ({ min, max }: TimeRange, by: number): TimeRange => ({ min: min + by, max: max + by });

/** The units of ROS (REP 103), by the last names in the path of a field. */
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

/** Returns the unit of a field; empty if it has none, or an unknown one. */
export const unitOf = (path: string): string => UNITS.find(([pattern]) => pattern.test(path))?.[1] ?? '';

/** Returns the unit that all fields share; empty if they differ. */
export function commonUnit(paths: readonly string[]): string {
  const units = new Set(paths.map(unitOf));
  return units.size === 1 ? ([...units][0] ?? '') : '';
}
