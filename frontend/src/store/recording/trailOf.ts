import { unpackPose, type PosesFrame } from './posesAt';

const STEP_M = 0.03;
const FASTEST_M_S = 5;
const MOST_POINTS = 6000;
const POSE_BYTES = 16;

/**
 * Returns the path of an object as x and y in m, time in s, and 1 where a path begins, for each point: it was
 * put elsewhere there. A long path has fewer points.
 */
export function trailOf(frames: Iterable<PosesFrame>, id: number): Float32Array {
  let numbers: number[] = [];
  let step = STEP_M;
  let last: readonly [x: number, y: number, t: number] | null = null;
  for (const { t, ids, poses } of frames) {
    const at = ids.indexOf(id);
    if (at < 0) continue;
    const [x, y] = unpackPose(poses, at * POSE_BYTES);
    const way = last ? Math.hypot(x - last[0], y - last[1]) : 0;
    const isJump = last === null || way > Math.max(STEP_M, (t - last[2]) * FASTEST_M_S);
    if (!isJump && way < step) continue;
    numbers.push(x, y, t, isJump ? 1 : 0);
    last = [x, y, t];
    if (numbers.length < MOST_POINTS * 4) continue;
    step *= 2;
    numbers = halved(numbers);
  }
  return Float32Array.from(numbers);
}

/** Returns every second point, and those at which a path begins. */
function halved(numbers: readonly number[]): number[] {
  const kept: number[] = [];
  for (let at = 0; at < numbers.length; at += 4)
    if (at % 8 === 0 || numbers[at + 3] === 1) kept.push(...numbers.slice(at, at + 4));
  return kept;
}
