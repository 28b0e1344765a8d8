import { create } from 'zustand';
import { frames } from './frames';
import { currentPoses } from './poses';

/** The speed of the first robot, measured from received poses. */
export interface Motion {
  speed: number;
  t: number;
}

interface Sample {
  t: number;
  x: number;
  y: number;
}

const WINDOW_S = 1;
const UPDATE_EVERY_S = 0.2;
/**
 * The time without poses after which the robot counts as stopped: poses arrive only while something moves.
 */
const STILL_AFTER_MS = 800;

export const useMotion = create<Motion>(() => ({ speed: 0, t: 0 }));

/** Returns the path length of the samples per simulated second. */
export function speedOf(samples: readonly Sample[]): number {
  const first = samples[0];
  const last = samples.at(-1);
  if (!first || !last || last.t <= first.t) return 0;
  let path = 0;
  samples.forEach(({ x, y }, index) => {
    const before = samples[index - 1];
    if (before) path += Math.hypot(x - before.x, y - before.y);
  });
  return path / (last.t - first.t);
}

let robotId: number | null = null;
let samples: Sample[] = [];
let stillness: ReturnType<typeof setTimeout> | undefined;

function stand(): void {
  samples = samples.slice(-1);
  useMotion.setState({ speed: 0 });
}

frames.listen('scene', (scene) => {
  robotId = scene.objects.find((object) => object.kind === 'robot')?.id ?? null;
  samples = [];
  useMotion.setState({ speed: 0, t: scene.t });
});

frames.listen('poses', ({ t }) => {
  const pose = robotId === null ? undefined : currentPoses.get(robotId);
  if (!pose) return;
  clearTimeout(stillness);
  stillness = setTimeout(stand, STILL_AFTER_MS);
  const last = samples.at(-1);
  if (last && t < last.t) samples = [];
  samples.push({ t, x: pose[0] ?? 0, y: pose[1] ?? 0 });
  while (samples.length > 2 && t - (samples[0]?.t ?? t) > WINDOW_S) samples.shift();
  if (Math.abs(t - useMotion.getState().t) >= UPDATE_EVERY_S) {
    useMotion.setState({ speed: speedOf(samples), t });
  }
});
