import type { CameraPose } from '@/generated/messages';

/** A camera that looks at a point from a direction: angles in rad, distance in m. */
export interface Orbit {
  target: [number, number, number];
  azimuth: number;
  elevation: number;
  distance: number;
}

export const START: Orbit = { target: [0, 0, 0.3], azimuth: -2.2, elevation: 0.75, distance: 9 };

const clamp = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

/** Returns the camera after a rotation by pixels of dragging. */
export function turned(orbit: Orbit, dx: number, dy: number): Orbit {
  return {
    ...orbit,
    azimuth: orbit.azimuth - dx * 0.008,
    elevation: clamp(orbit.elevation + dy * 0.008, 0.05, 1.55),
  };
}

/** Returns the camera after a move over the ground by pixels of dragging. */
export function panned(orbit: Orbit, dx: number, dy: number): Orbit {
  const scale = orbit.distance * 0.0015;
  const [x, y, z] = orbit.target;
  const sin = Math.sin(orbit.azimuth);
  const cos = Math.cos(orbit.azimuth);
  return { ...orbit, target: [x + (dx * sin - dy * cos) * scale, y + (-dx * cos - dy * sin) * scale, z] };
}

export function zoomed(orbit: Orbit, factor: number): Orbit {
  return { ...orbit, distance: clamp(orbit.distance * factor, 0.5, 60) };
}

export function poseOf({ target, azimuth, elevation, distance }: Orbit): CameraPose {
  const flat = distance * Math.cos(elevation);
  return {
    eye: [
      target[0] + flat * Math.cos(azimuth),
      target[1] + flat * Math.sin(azimuth),
      target[2] + distance * Math.sin(elevation),
    ],
    target,
  };
}
